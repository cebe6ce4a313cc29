// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "diabolo/evaluate/start_state.hpp"
#include "diabolo/math/bootstrap.hpp"
#include "diabolo/math/solve_symmetric.hpp"

namespace diabolo {

/// By how much a fair start is off, one standard deviation of one coordinate.
struct StartNoise {
  double position = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
};

/// As seen from the frames around each row: how far the recorded position lies from the polynomial of degree
/// four through the frames of kStartWindow before and after it, and how far the fair start's velocity is from
/// its slope. Medians, so that catches count little. Zero where the recording is too short to tell. Throws
/// RecordingError where the recording is not what its type promises.
inline StartNoise start_noise(const Recording& recording) {
  constexpr int kPowers = 4;  // of the polynomial: its degree
  const VelocityFilter causal = start_velocity_filter(recording.rate);
  // A local polynomial takes 1000 frames at most.
  const int half = std::min(static_cast<int>(causal.weight.size()) - 1, 499), frames = 2 * half + 1;
  const Velocity fair = velocity(recording, recording.diabolo, causal);
  const Velocity around =
      velocity(recording, recording.diabolo, local_polynomial(frames, kPowers, FilterWindow::kCentred));
  // The polynomial's height in the middle, by least squares.
  Eigen::MatrixXd powers(frames, kPowers + 1);
  for (int i = 0; i < frames; ++i)
    for (int k = 0; k <= kPowers; ++k) powers(i, k) = std::pow(static_cast<double>(i - half) / half, k);
  const Eigen::MatrixXd squares = powers.transpose() * powers,
                        middle = Eigen::MatrixXd::Identity(kPowers + 1, 1);
  const Eigen::VectorXd height = powers * solve_symmetric(squares, middle);
  const double kept = std::sqrt(1.0 - height[half]);  // of independent noise, beside the polynomial
  std::vector<double> positions, velocities;
  for (Eigen::Index i = half; i + half < recording.size(); ++i) {
    if (!around.valid[i] || !fair.valid[i]) continue;
    const Vector3<double> smooth = recording.diabolo.position.middleCols(i - half, frames) * height;
    const Vector3<double> off = (recording.diabolo.position.col(i) - smooth) / kept;
    const Vector3<double> slope_off = fair.velocity.col(i) - around.velocity.col(i);
    for (int k = 0; k < 3; ++k) {
      positions.push_back(std::abs(off[k]));
      velocities.push_back(std::abs(slope_off[k]));
    }
  }
  if (positions.empty()) return {};
  return {kMedianToDeviation * median_of(std::move(positions)),
          kMedianToDeviation * median_of(std::move(velocities))};
}

/// A start that is as likely as the given one.
inline State<double> drawn_start(State<double> state, const StartNoise& noise, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  for (int k = 0; k < 3; ++k) {
    state.position[k] += noise.position * normal(generator);
    state.velocity[k] += noise.velocity * normal(generator);
  }
  return state;
}

}  // namespace diabolo
