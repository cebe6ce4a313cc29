// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "diabolo/robot/arm/stick_map.hpp"

namespace diabolo {

/// How fast the tip may go in a direction (any length) before a joint exceeds `joint_speed` [m/s].
inline double tip_speed(const StickMap::Slopes& slopes, const Vector3<double>& direction,
                        double joint_speed = kUr5eJointSpeed) {
  const Joints<double> rates = slopes * direction;
  const double fastest = rates.cwiseAbs().maxCoeff();
  return fastest > 0 ? joint_speed * direction.norm() / fastest : std::numeric_limits<double>::infinity();
}

/// The same in the slowest direction: there one joint alone sets the pace.
inline double slowest_tip_speed(const StickMap::Slopes& slopes, double joint_speed = kUr5eJointSpeed) {
  return joint_speed / slopes.rowwise().norm().maxCoeff();
}

}  // namespace diabolo
