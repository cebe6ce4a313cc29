// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "diabolo/recording/check.hpp"
#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// A linear estimate of velocity: v[i] = rate * sum over k of weight[k] * p[i + first + k].
struct VelocityFilter {
  Eigen::VectorXd weight;
  Eigen::Index first;  ///< offset of the first sample used, <= 0 but for odd filters

  /// Response at a frequency in cycles per sample, over that of true differentiation: 1 at frequency 0.
  std::complex<double> response(double frequency) const {
    const double phase = 2.0 * std::numbers::pi * frequency;
    if (phase == 0.0) return 1.0;
    std::complex<double> sum = 0.0;
    for (Eigen::Index k = 0; k < weight.size(); ++k)
      sum += weight[k] * std::polar(1.0, phase * static_cast<double>(first + k));
    return sum / std::complex<double>(0.0, phase);
  }

  /// -3 dB bandwidth [Hz]: the lowest frequency at which the response falls to 1/sqrt(2) of true
  /// differentiation; half the rate where it never does.
  double bandwidth(double rate) const {
    const double target = 1.0 / std::numbers::sqrt2;
    for (int k = 1; k <= kFrequencies; ++k) {
      if (std::abs(response(0.5 * k / kFrequencies)) > target) continue;
      double low = 0.5 * (k - 1) / kFrequencies, high = 0.5 * k / kFrequencies;
      for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (low + high);
        (std::abs(response(middle)) > target ? low : high) = middle;
      }
      return high * rate;
    }
    return 0.5 * rate;
  }

  /// Largest response over all frequencies: above 1 the filter exaggerates some motions.
  double peak_gain() const {
    double peak = 1.0;
    for (int k = 1; k <= kFrequencies; ++k) peak = std::max(peak, std::abs(response(0.5 * k / kFrequencies)));
    return peak;
  }

  /// Standard deviation of the velocity [m/s] per standard deviation of independent position noise [m].
  double noise_gain(double rate) const { return rate * weight.norm(); }

  /// How late the estimate is for slow motions [s]; negative where it looks ahead.
  double delay(double rate) const {
    double moment = 0.0;
    for (Eigen::Index k = 0; k < weight.size(); ++k) {
      const double offset = static_cast<double>(first + k);
      moment += 0.5 * weight[k] * offset * offset;
    }
    return -moment / rate;
  }

 private:
  static constexpr int kFrequencies = 2000;
};

/// The published rule, (p[i+1] - p[i]) * rate: bandwidth 0.443 of the rate, noise gain 1.41 rate, half a
/// frame early.
inline VelocityFilter forward_difference() { return {Eigen::Vector2d(-1.0, 1.0), 0}; }

/// (p[i+1] - p[i-1]) * rate / 2: bandwidth 0.221 of the rate, noise gain 0.71 rate, no delay.
inline VelocityFilter central_difference() { return {Eigen::Vector3d(-0.5, 0.0, 0.5), -1}; }

/// Where the frames of a local polynomial lie.
enum class FilterWindow {
  kCausal,   ///< the sample and those before it: nothing after the start of a prediction is used
  kCentred,  ///< as many on both sides (an odd number of frames)
};

/// Slope, at the sample, of the polynomial of a degree fitted to a window of frames by least squares
/// (Savitzky and Golay 1964): exact for motions of that degree. See bandwidth() and noise_gain() for what a
/// choice gives. Throws std::invalid_argument unless 1 <= degree < frames <= 1000, degree <= 8.
inline VelocityFilter local_polynomial(int frames, int degree, FilterWindow window) {
  if (degree < 1 || degree > 8 || frames <= degree || frames > 1000)
    throw std::invalid_argument("local polynomial: degree " + std::to_string(degree) + " over " +
                                std::to_string(frames) +
                                " frames; expected 1 <= degree < frames <= 1000, degree <= 8");
  if (window == FilterWindow::kCentred && frames % 2 == 0)
    throw std::invalid_argument("local polynomial: " + std::to_string(frames) +
                                " frames; a centred window has an odd number");
  const Eigen::Index first = window == FilterWindow::kCausal ? 1 - frames : -(frames / 2);
  // Sum over d of p_d(x_k) p_d'(0) / |p_d|^2, with the polynomials orthogonal over the window (Forsythe
  // 1957).
  const Eigen::ArrayXd x =
      Eigen::ArrayXd::LinSpaced(frames, static_cast<double>(first), static_cast<double>(first + frames - 1));
  Eigen::ArrayXd before = Eigen::ArrayXd::Zero(frames), p = Eigen::ArrayXd::Constant(frames, 1.0);
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(frames);
  double square_before = 1.0, here_before = 0.0, here = 1.0, slope_before = 0.0, slope = 0.0;
  for (int d = 0;; ++d) {
    const double square = p.square().sum();
    weight += (p * (slope / square)).matrix();
    if (d == degree) return {weight, first};
    const double a = (x * p.square()).sum() / square, b = d == 0 ? 0.0 : square / square_before;
    const Eigen::ArrayXd next = (x - a) * p - b * before;
    before = std::exchange(p, next);
    slope_before = std::exchange(slope, here - a * slope - b * slope_before);
    here_before = std::exchange(here, -a * here - b * here_before);
    square_before = square;
  }
}

/// Velocities over N samples.
struct Velocity {
  Eigen::Matrix3Xd velocity;  ///< [m/s], 3 x N; NaN where not valid
  Marks valid;                ///< N
};

/// Velocity of a track of `recording` by a filter. Valid only where every frame in the window is valid and
/// follows the one before by one sampling period. Throws RecordingError where the recording or the track is
/// not what it promises.
inline Velocity velocity(const Recording& recording, const Track& track, const VelocityFilter& filter) {
  check_recording(recording);
  const Eigen::Index size = recording.size(), length = filter.weight.size();
  check_track(track, size, "track of " + recording.title());
  Velocity result{Eigen::Matrix3Xd::Constant(3, size, kNaN), Marks::Constant(size, false)};
  Eigen::Index usable = 0;  // frames without a gap, up to and with `last`
  for (Eigen::Index last = 0; last < size; ++last) {
    const bool joined = last > 0 && recording.steps_evenly(last - 1);
    usable = track.valid[last] ? (joined ? usable + 1 : 1) : 0;
    const Eigen::Index i = last - filter.first - length + 1;
    if (usable < length || i < 0 || i >= size) continue;
    result.velocity.col(i) =
        track.position.middleCols(last - length + 1, length) * filter.weight * recording.rate;
    result.valid[i] = true;
  }
  return result;
}

}  // namespace diabolo
