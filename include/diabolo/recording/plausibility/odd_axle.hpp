// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "diabolo/recording/plausibility/fall.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Fastest usual turn of an axle, twice what a player makes of it [rad/s]; the least and the largest turn
/// from row to row [rad] that anything is concluded from.
inline constexpr double kFastAxle = 6.0, kLeastAxleTurn = 0.15, kMostAxleTurn = 0.5;

/// Largest usual |cosine| between the axle and the line from tip to tip (45 degrees).
inline constexpr double kMostAlong = 0.7;

/// A clause about a body x that is not the axle, or about orientations that were not tracked; else empty. The
/// axle lies across the string.
inline std::string odd_axle(const Recording& r) {
  const OrientationTrack& track = r.diabolo_orientation;
  if (track.empty()) return {};
  const auto axle = [&track](Eigen::Index i) {
    return Eigen::Quaterniond(Eigen::Vector4d(track.quaternion.col(i))) * Eigen::Vector3d::UnitX();
  };
  std::vector<double> turns, along;
  bool turns_at_all = false;
  std::size_t moves = 0;
  for (Eigen::Index i = 0; i + 1 < r.size(); ++i) {
    if (!track.valid[i] || !track.valid[i + 1] || !r.steps_evenly(i)) continue;
    turns_at_all = turns_at_all || track.quaternion.col(i) != track.quaternion.col(i + 1);
    moves += r.diabolo.valid[i] && r.diabolo.valid[i + 1] &&
             r.diabolo.position.col(i) != r.diabolo.position.col(i + 1);
    turns.push_back(axle(i).cross(axle(i + 1)).norm());
    if (r.left.valid[i] && r.right.valid[i])
      along.push_back(std::abs(axle(i).dot((r.left.position.col(i) - r.right.position.col(i)).normalized())));
  }
  if (static_cast<double>(turns.size()) < kFewestSeconds * r.rate) return {};
  if (!turns_at_all && 2 * moves > turns.size())
    return "the diabolo's orientation never changes: it was not tracked";
  const double turn = recording_plausibility_detail::median_of(turns),
               most = std::max(kLeastAxleTurn, kFastAxle / r.rate);
  if (most <= kMostAxleTurn && turn >= most)
    return "the diabolo's body x turns by " + shown_rounded(turn) +
           " rad from row to row: it is not the axle, or the quaternions are not in the order x, y, z, w";
  if (!along.empty() && recording_plausibility_detail::median_of(along) > kMostAlong)
    return "the diabolo's body x points from tip to tip, along the string: it is not the axle, which is "
           "expected to be body x, not y or z";
  return {};
}

}  // namespace diabolo
