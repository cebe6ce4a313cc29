// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "diabolo/robot/arm/joints.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Joints of both arms, the left one's six and then the right one's [rad].
using PairJoints = Eigen::Matrix<double, 2 * kJointCount, 1>;

/// Seconds from one setpoint to the next: the controller's 500 Hz.
inline constexpr double kTick = 0.002;

/// What each joint of either arm may do. A UR5e's maker names the speed alone, pi rad/s; acceleration and
/// jerk are ours, to be tuned on the arm, whose real limits are those of its torques.
struct JointLimits {
  std::array<double, kJointCount> speed, acceleration, jerk;  ///< [rad/s], [rad/s^2], [rad/s^3]

  /// The same for every joint.
  static JointLimits uniform(double speed = 0.95 * kPi, double acceleration = 15.0, double jerk = 500.0) {
    JointLimits limits{};
    limits.speed.fill(speed);
    limits.acceleration.fill(acceleration);
    limits.jerk.fill(jerk);
    return limits;
  }
};

/// Throws std::invalid_argument that names the limit which is not finite and above zero.
inline void check_limits(const JointLimits& limits) {
  for (const auto& [name, values] :
       {std::pair{"speed", limits.speed}, std::pair{"acceleration", limits.acceleration},
        std::pair{"jerk", limits.jerk}})
    for (std::size_t i = 0; i < kJointCount; ++i)
      if (!(values[i] > 0) || !std::isfinite(values[i]))
        throw std::invalid_argument(std::string("limits, ") + name + " of joint " + std::to_string(i + 1) +
                                    ": " + shown(values[i]) + "; must be finite and > 0");
}

/// How much slower the step from the last of four setpoints would have to be for the limits to hold: the
/// largest of speed over limit, the root of that of the acceleration and the third root of that of the jerk,
/// by differences of setpoints one tick apart.
inline double excess(const PairJoints& a, const PairJoints& b, const PairJoints& c, const PairJoints& d,
                     const JointLimits& limits) {
  const PairJoints speed = (d - c) / kTick, acceleration = (d - 2 * c + b) / (kTick * kTick),
                   jerk = (d - 3 * c + 3 * b - a) / (kTick * kTick * kTick);
  double v = 0, w = 0, j = 0;
  for (int i = 0; i < 2 * kJointCount; ++i) {
    const std::size_t k = static_cast<std::size_t>(i % kJointCount);
    v = std::max(v, std::abs(speed[i]) / limits.speed[k]);
    w = std::max(w, std::abs(acceleration[i]) / limits.acceleration[k]);
    j = std::max(j, std::abs(jerk[i]) / limits.jerk[k]);
  }
  return std::max({v, std::sqrt(w), std::cbrt(j)});
}

}  // namespace diabolo
