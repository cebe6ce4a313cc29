// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "diabolo/state.hpp"

namespace diabolo {

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

/// A diabolo that hangs at rest at the lowest point between the tips [m], with a spin [rad/s].
inline State<double> hanging_state(const Eigen::Vector3d& left, const Eigen::Vector3d& right,
                                   double string_length, double spin = 0.0) {
  State<double> state;
  state.position = lowest_point(left, right, string_length);
  state.spin = spin;
  state.string_state = StringState::kOnString;
  return state;
}

}  // namespace diabolo
