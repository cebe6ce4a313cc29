// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "diabolo.hpp"

namespace plant {

/// How far [m] the left hand goes forward, and the right hand back, to turn the axis level and forward again.
/// The torque of the two strands then turns a fast axis up or down at right angles to the spin; yaw follows,
/// because a pitched axis makes the string climb the groove.
inline double steering_offset(const DiaboloParameters& diabolo, const State& state) {
  constexpr double kFarthest = 0.12;  // [m]
  constexpr double kForYaw = 0.6;     // [m/rad]
  constexpr double kForPitch = 0.6;   // [m/rad]
  const Vec3 axis = state.col(kAxis);
  const double yaw = std::atan2(axis.y(), axis.x());
  const double pitch = std::asin(std::clamp(axis.z(), -1.0, 1.0));
  const double sense = play_spin(diabolo, state) > 0.0 ? 1.0 : -1.0;
  return std::clamp(-kForYaw * yaw - sense * kForPitch * pitch, -kFarthest, kFarthest);
}

}  // namespace plant
