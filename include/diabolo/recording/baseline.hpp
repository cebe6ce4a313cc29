// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/recording/dropouts.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/spheroid.hpp"

namespace diabolo {

/// String length of the lowest-point baseline [m].
inline constexpr double kBaselineStringLength = 1.45;

/// The lowest point of the spheroid [m]: where a diabolo on a frictionless string of that length rests. Tips
/// as far apart as the string, or farther: the lower end of the segment that the spheroid has become, or its
/// middle where it is level.
inline Eigen::Vector3d lowest_point(const Spheroid<double>& spheroid) {
  const double b = spheroid.overstretched() ? 0.0 : spheroid.semi_minor();
  const double a = spheroid.semi_major(), slope = -spheroid.axis().z();
  // The support point of the ellipsoid x' M^-1 x = 1, M = b^2 I + (a^2 - b^2) u u', in the direction -z.
  const Eigen::Vector3d down =
      Eigen::Vector3d(0.0, 0.0, -b * b) + spheroid.axis() * ((a * a - b * b) * slope);
  const double depth_squared = b * b + (a * a - b * b) * slope * slope;
  if (!(depth_squared > 0.0)) return spheroid.center();
  return spheroid.center() + down / std::sqrt(depth_squared);
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
    result.position.col(i) =
        lowest_point(Spheroid<double>(left.position.col(i), right.position.col(i), kBaselineStringLength));
  }
  return result;
}

}  // namespace diabolo
