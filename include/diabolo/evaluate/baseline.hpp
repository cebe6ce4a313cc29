// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "diabolo/recording/dropouts.hpp"
#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// String length of the lowest-point baseline [m].
inline constexpr double kBaselineStringLength = 1.45;

/// The lowest point of the spheroid around the tips [m]: where a diabolo on a frictionless string of that
/// length rests. Tips as far apart as the string, or farther: the semi-minor axis counts as zero, so that the
/// spheroid is a segment on their line, and its lower end is meant; its middle where it is level.
inline Eigen::Vector3d lowest_point(const Eigen::Vector3d& left, const Eigen::Vector3d& right,
                                    double string_length) {
  const Eigen::Vector3d span = left - right;
  const double distance = span.norm(), a = 0.5 * string_length;
  const double b_squared = std::max(0.0, (a - 0.5 * distance) * (a + 0.5 * distance));
  const Eigen::Vector3d axis = distance > 0.0 ? Eigen::Vector3d(span / distance) : span;
  // The support point of the ellipsoid x' M^-1 x = 1 with M = b^2 I + (a^2 - b^2) axis axis' in direction -z.
  const double along = -axis.z() * (a * a - b_squared);
  const double depth = std::sqrt(b_squared - along * axis.z());
  Eigen::Vector3d middle = 0.5 * (left + right);
  if (!(depth > 0.0)) return middle;
  return middle + (axis * along - Eigen::Vector3d(0.0, 0.0, b_squared)) / depth;
}

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
