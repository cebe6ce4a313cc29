// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace plant {

inline constexpr double kRestingSpin = 1.0;  ///< below it the axle's drag fades away [rad/s]

/// Torque [N m] of the air about the cups, `windage` [N m s^2/rad^2] per spin squared.
inline double windage_torque(double windage, double spin) { return -windage * std::abs(spin) * spin; }

/// Torque [N m] of a drag that slows the spin by `drag` [rad/s^2] whatever its speed.
inline double axle_torque(double drag, double axial_inertia, double spin) {
  return -drag * axial_inertia * std::tanh(spin / kRestingSpin);
}

}  // namespace plant
