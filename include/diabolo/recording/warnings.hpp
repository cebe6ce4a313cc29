// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/recording/odd_stretches.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/recording/start_state.hpp"
#include "diabolo/recording/swapped_bodies.hpp"
#include "diabolo/recording/usual_path.hpp"

namespace diabolo {

/// Longest time [s] for which a tip may be unseen: half a beat of a player's hands, more than which no curve
/// through what was seen before and after can make up for.
inline constexpr double kLongestUnseen = 0.25;

/// Longest time [s] for which a body may seem to rest to the last digit.
inline constexpr double kLongestRest = 0.1;

/// Longest time without rows [s], and the largest part of a recording that may miss.
inline constexpr double kLongestWithoutRows = 0.1, kMostWithoutRows = 0.05;

/// Usual turn of an axle from row to row at most [rad]; a player turns it by two or three radians a second.
inline constexpr double kFastAxle = 0.15;

namespace detail {

/// A clause about a diabolo that is above the tips for most of the time, at least two seconds; else empty.
inline std::string odd_height(const Recording& r) {
  Eigen::Index above = 0, known = 0;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (!r.left.valid[i] || !r.right.valid[i] || !r.diabolo.valid[i]) continue;
    ++known;
    above += height_above_tips<double>(r.diabolo.position.col(i), r.left.position.col(i),
                                       r.right.position.col(i)) > 0.0;
  }
  if (static_cast<double>(known) < kFewestSeconds * r.rate || 2 * above <= known) return {};
  return "the diabolo is above the tips in " + std::to_string(100 * above / known) +
         " % of the rows: an axis other than z points up, or bodies are swapped";
}

/// A clause about the diabolo's orientations where they are none of a diabolo; else empty.
inline std::string odd_axle(const Recording& r) {
  const OrientationTrack& track = r.diabolo_orientation;
  if (track.empty()) return {};
  const auto axle = [&track](Eigen::Index i) {
    return Eigen::Quaterniond(Eigen::Vector4d(track.quaternion.col(i))) * Eigen::Vector3d::UnitX();
  };
  std::vector<double> turns;
  bool changes = false;
  for (Eigen::Index i = 0; i + 1 < r.size(); ++i) {
    if (!track.valid[i] || !track.valid[i + 1] || !r.steps_evenly(i)) continue;
    changes = changes || track.quaternion.col(i) != track.quaternion.col(i + 1);
    turns.push_back(axle(i).cross(axle(i + 1)).norm());
  }
  if (static_cast<double>(turns.size()) < kFewestSeconds * r.rate) return {};
  if (!changes) return "the diabolo's orientation never changes: it was not tracked";
  const auto middle = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2);
  std::nth_element(turns.begin(), middle, turns.end());
  if (*middle < kFastAxle) return {};
  return "the diabolo's body x turns by " + Stretches::rounded(*middle) +
         " rad from row to row: it is not the axle, or the quaternions are not in the order x, y, z, w";
}

/// A clause about bodies under each other's names; else empty.
inline std::string odd_names(const Recording& r) {
  if (sticks_are_exchanged(r).value_or(false))
    return "seen along the sticks, the left one is on the right: they are under each other's names";
  Recording given = r;
  if (const Swaps swaps = unswap(given); swaps.count > 0)
    return "bodies jump to each other's places in " + std::to_string(swaps.count) + " rows, first in rows " +
           std::to_string(swaps.rows.front().first) + " to " + std::to_string(swaps.rows.front().second);
  return {};
}

}  // namespace detail

/// What is odd about a recording that is well formed: each a clause that says what is found and what it
/// means. Whatever is computed from such a recording deserves a second look.
inline std::vector<std::string> warnings(const Recording& recording) {
  std::vector<std::string> result;
  for (std::string clause : {odd_path_length(recording), detail::odd_height(recording),
                             detail::odd_axle(recording), detail::odd_names(recording)})
    if (!clause.empty()) result.push_back(std::move(clause));
  for (const auto& [side, tip] : {std::pair{"left", &recording.left}, std::pair{"right", &recording.right}})
    if (const Stretches gap = unseen(*tip, recording.time, kLongestUnseen); gap.count > 0)
      result.push_back(std::string("the ") + side + " tip is not seen for " + gap.text() +
                       "; a prediction across it goes by a guess");
  if (const Stretches none = without_rows(recording);
      none.length > kLongestWithoutRows ||
      none.total >
          kMostWithoutRows *
              (recording.size() > 0 ? recording.time[recording.size() - 1] - recording.time[0] : 0.0))
    if (none.count > 0) result.push_back("there are no rows for " + none.text());
  for (const auto& [name, track] :
       {std::pair{"left tip", &recording.left}, std::pair{"right tip", &recording.right},
        std::pair{"diabolo", &recording.diabolo}})
    if (const Stretches rest = frozen(recording, *track, kLongestRest); rest.count > 0)
      result.push_back(std::string("the ") + name + " does not move by a digit for " + rest.text() +
                       ": frozen tracking");
  return result;
}

}  // namespace diabolo
