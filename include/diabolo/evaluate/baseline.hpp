// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "diabolo/recording/dropouts.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/string/hanging.hpp"

namespace diabolo {

/// String length of the lowest-point baseline [m].
inline constexpr double kBaselineStringLength = 1.45;

/// The baseline that every model has to beat: at each row the diabolo is at the lowest point of the spheroid
/// of kBaselineStringLength, whatever happened before. A missing tip stays where it was seen last; rows
/// before both tips were seen are dropouts.
inline Track baseline_track(const Recording& recording) {
  const Track left = hold_last_valid(recording.left), right = hold_last_valid(recording.right);
  Track result = Track::missing(recording.size());
  for (Eigen::Index i = 0; i < recording.size(); ++i) {
    if (!left.valid[i] || !right.valid[i]) continue;
    result.valid[i] = true;
    result.position.col(i) = lowest_point(left.position.col(i), right.position.col(i), kBaselineStringLength);
  }
  return result;
}

}  // namespace diabolo
