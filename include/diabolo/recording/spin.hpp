// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "diabolo/recording/check.hpp"
#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// Spin between each sample and the next.
///
/// It aliases: a camera at `rate` tells turns apart only up to half a turn per frame, which is 60 rev/s (377
/// rad/s) at 120 Hz. Faster spin folds back, in the unsigned rule to a lower value, in the signed one to the
/// other sign.
struct Spin {
  Eigen::VectorXd value;  ///< [rad/s], N; NaN where not valid
  Marks valid;            ///< N; sample i needs samples i and i + 1, so the last is never valid
};

/// Largest spin that a sampling rate [Hz] tells apart [rad/s].
inline double largest_spin(double rate) { return std::numbers::pi * rate; }

/// Smallest |cosine| between spin axis and world x at which signed_spin() tells the sides apart (84 degrees).
inline constexpr double kSmallestHeading = 0.1;

/// `rule(first, second)` in [rad] per frame over each two successive orientations; NaN from it marks a sample
/// invalid.
template <class Rule>
Spin spin_by(const Recording& recording, const Rule& rule) {
  check_recording(recording);
  const Eigen::Index size = recording.size();
  Spin spin{Eigen::VectorXd::Constant(size, kNaN), Marks::Constant(size, false)};
  const OrientationTrack& track = recording.diabolo_orientation;
  if (track.empty()) return spin;
  for (Eigen::Index i = 0; i + 1 < size; ++i) {
    if (!track.valid[i] || !track.valid[i + 1] || !recording.steps_evenly(i)) continue;
    const Eigen::Quaterniond first(Eigen::Vector4d(track.quaternion.col(i)));
    const Eigen::Quaterniond second(Eigen::Vector4d(track.quaternion.col(i + 1)));
    spin.value[i] = rule(first, second) * recording.rate;
    spin.valid[i] = !std::isnan(spin.value[i]);
  }
  return spin;
}

/// The mean of the spins between the rows within `half` of each; NaN where fewer than half of them are valid.
inline Eigen::VectorXd moving_mean(const Spin& spin, Eigen::Index half) {
  const Eigen::Index size = spin.value.size();
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(size + 1), counts = Eigen::VectorXd::Zero(size + 1);
  for (Eigen::Index i = 0; i < size; ++i) {
    sums[i + 1] = sums[i] + (spin.valid[i] ? spin.value[i] : 0.0);
    counts[i + 1] = counts[i] + (spin.valid[i] ? 1.0 : 0.0);
  }
  Eigen::VectorXd mean = Eigen::VectorXd::Constant(size, kNaN);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::Index first = std::max<Eigen::Index>(i - half, 0), end = std::min(i + half, size);
    const double count = counts[end] - counts[first];
    if (count > 0.0 && 2.0 * count >= static_cast<double>(end - first))
      mean[i] = (sums[end] - sums[first]) / count;
  }
  return mean;
}

/// The published rule: the angle between successive orientations times the rate. Never negative; turning of
/// the axle counts as spin too.
inline Spin unsigned_spin(const Recording& recording) {
  return spin_by(recording, [](const Eigen::Quaterniond& first, const Eigen::Quaterniond& second) {
    return first.angularDistance(second);
  });
}

/// Spin about the axle alone (the twist of the relative rotation about body x). Positive when the axle
/// surface under the string moves towards the right tip, which is rotation about world -x; body x may point
/// either way along the axle. Invalid where the axle is so nearly square to world x (kSmallestHeading) that
/// it has no such side, and where it tips by more than 90 degrees in one frame.
inline Spin signed_spin(const Recording& recording) {
  return spin_by(recording, [](const Eigen::Quaterniond& first, const Eigen::Quaterniond& second) {
    const double heading = (first * Eigen::Vector3d::UnitX()).x();
    const Eigen::Quaterniond turn = first.conjugate() * second;
    if (std::abs(heading) < kSmallestHeading || turn.x() * turn.x() + turn.w() * turn.w() < 0.5) return kNaN;
    // A quaternion and its negative are the same rotation: w >= 0 is the turn of at most half a turn.
    const double angle = 2.0 * std::atan2(turn.w() < 0.0 ? -turn.x() : turn.x(), std::abs(turn.w()));
    return heading > 0.0 ? -angle : angle;
  });
}

}  // namespace diabolo
