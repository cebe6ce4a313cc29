// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "diabolo/recording/plausibility/swapped_bodies.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A clause about a diabolo within the string's reach that is above the tips for most of the time; else
/// empty.
inline std::string odd_height(const Recording& r) {
  Eigen::Index above = 0, known = 0;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (!r.left.valid[i] || !r.right.valid[i] || !r.diabolo.valid[i]) continue;
    if (path_at(r, i).length() > r.string_length + kOddPathLength) continue;  // it flies
    ++known;
    above += height_above_tips<double>(r.diabolo.position.col(i), r.left.position.col(i),
                                       r.right.position.col(i)) > 0.0;
  }
  if (static_cast<double>(known) < kFewestSeconds * r.rate || 2 * above <= known) return {};
  return "the diabolo is above the tips in " + std::to_string(100 * above / known) +
         " % of the rows in which the string reaches it: an axis other than z points up, or bodies are "
         "swapped";
}

/// Fastest usual turn of an axle, twice what a player makes of it [rad/s]; the least and the largest turn
/// from row to row [rad] that anything is concluded from.
inline constexpr double kFastAxle = 6.0, kLeastAxleTurn = 0.15, kMostAxleTurn = 0.5;

/// A clause about the diabolo's orientations where they are none of a diabolo; else empty.
inline std::string odd_axle(const Recording& r) {
  const OrientationTrack& track = r.diabolo_orientation;
  if (track.empty()) return {};
  const auto axle = [&track](Eigen::Index i) {
    return Eigen::Quaterniond(Eigen::Vector4d(track.quaternion.col(i))) * Eigen::Vector3d::UnitX();
  };
  std::vector<double> turns;
  bool turns_at_all = false;
  std::size_t moves = 0;
  for (Eigen::Index i = 0; i + 1 < r.size(); ++i) {
    if (!track.valid[i] || !track.valid[i + 1] || !r.steps_evenly(i)) continue;
    turns_at_all = turns_at_all || track.quaternion.col(i) != track.quaternion.col(i + 1);
    moves += r.diabolo.valid[i] && r.diabolo.valid[i + 1] &&
             r.diabolo.position.col(i) != r.diabolo.position.col(i + 1);
    turns.push_back(axle(i).cross(axle(i + 1)).norm());
  }
  if (static_cast<double>(turns.size()) < kFewestSeconds * r.rate) return {};
  if (!turns_at_all && 2 * moves > turns.size())
    return "the diabolo's orientation never changes: it was not tracked";
  const auto middle = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2);
  std::nth_element(turns.begin(), middle, turns.end());
  const double most = std::max(kLeastAxleTurn, kFastAxle / r.rate);
  if (most > kMostAxleTurn || *middle < most) return {};
  return "the diabolo's body x turns by " + shown_rounded(*middle) +
         " rad from row to row: it is not the axle, or the quaternions are not in the order x, y, z, w";
}

/// "2.5 s to 2.75 s and 3 times more": when bodies were under each other's names.
inline std::string times_of(const Swaps& swaps, const Eigen::VectorXd& time) {
  const auto [first, last] = swaps.rows.front();
  const std::size_t more = swaps.rows.size() - 1;
  return shown_rounded(time[first]) + " s to " + shown_rounded(time[last]) + " s" +
         (more > 0 ? " and " + std::to_string(more) + (more > 1 ? " times more" : " time more") : "");
}

/// A clause about bodies under each other's names; else empty.
inline std::string odd_names(const Recording& r) {
  if (sticks_are_exchanged(r).value_or(false))
    return "seen along the sticks, the left one is on the right: they are under each other's names";
  Recording given = r;
  if (const Swaps swaps = unswap(given); swaps.count > 0)
    return "bodies jump to each other's places, from " + times_of(swaps, r.time);
  return {};
}

}  // namespace diabolo
