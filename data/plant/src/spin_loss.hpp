// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "air.hpp"

namespace plant {

inline constexpr double kRestingSpin = 1.0;  ///< below it the axle's drag fades away [rad/s]

/// Torque [N m] of the air about the cups.
inline double windage_torque(const AirParameters& air, double spin) {
  if (air.windage_power == 2.0) return -air.windage * std::abs(spin) * spin;
  return -air.windage * std::copysign(raised(std::abs(spin), air.windage_power, kReferenceSpin), spin);
}

/// Torque [N m] of a drag that slows the spin by `drag` [rad/s^2] whatever its speed.
inline double axle_torque(double drag, double axial_inertia, double spin) {
  return -drag * axial_inertia * std::tanh(spin / kRestingSpin);
}

/// Torque [N m] about the axis that comes and goes with time [s].
inline double gust_torque(const AirParameters& air, double axial_inertia, double time) {
  return air.spin_gust * axial_inertia * gust_share(air, time);
}

}  // namespace plant
