// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace diabolo {

/// The shortest rotation of one unit vector onto another: (1 + a . b, a x b) points along it. Of opposite
/// ones any perpendicular axis serves. (Eigen's FromTwoVectors() takes seconds to compile, for its SVD.)
inline Eigen::Quaterniond shortest_turn(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  constexpr double kOpposite = 1e-12;
  const double w = 1.0 + from.dot(to);
  const Eigen::Vector3d axis = w > kOpposite ? Eigen::Vector3d(from.cross(to)) : from.unitOrthogonal();
  return Eigen::Quaterniond(w > kOpposite ? w : 0.0, axis.x(), axis.y(), axis.z()).normalized();
}

}  // namespace diabolo
