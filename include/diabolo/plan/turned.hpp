// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "diabolo/sticks.hpp"

namespace diabolo {

/// A motion of the hands that is turned to the left by `heading` and `lead` [rad] about the vertical through
/// `pivot`. The player faces along the heading; the lead sets the right hand forward and the left one back,
/// as a player does who tilts the axle, and leaves the string's shape as it is.
struct Turned {
  double heading = 0.0, lead = 0.0;
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator()(const Eigen::Vector3d& v) const {
    const double c = std::cos(heading + lead), s = std::sin(heading + lead);
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
  }
  /// Places alone.
  Tips<double> operator()(Tips<double> tips) const {
    tips.left = pivot + (*this)(Eigen::Vector3d(tips.left - pivot));
    tips.right = pivot + (*this)(Eigen::Vector3d(tips.right - pivot));
    return tips;
  }
};

}  // namespace diabolo
