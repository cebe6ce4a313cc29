// SPDX-License-Identifier: MIT
#pragma once

#include "geometry.hpp"

namespace plant {

/// Air about the diabolo's centre; u is the diabolo's velocity through the air.
struct AirParameters {
  double linear_drag = 0.0;  ///< acceleration per speed, against u [1/s]
  double drag = 0.028;       ///< acceleration per speed squared, against u [1/m]
  double magnus = 0.0011;    ///< acceleration per spin and speed, along axis x u [1/rad]
  Vec3 wind = Vec3::Zero();  ///< velocity of the air, world frame [m/s]
  double windage = 3e-8;     ///< torque per spin squared, against the spin [N m s^2/rad^2]
};

/// Acceleration [m/s^2] that the air gives to the centre of mass; `spin` is about the unit vector `axis`.
inline Vec3 air_acceleration(const AirParameters& air, const Vec3& velocity, const Vec3& axis, double spin) {
  const Vec3 through_air = velocity - air.wind;
  const double drag = air.linear_drag + air.drag * through_air.norm();
  return -drag * through_air + air.magnus * spin * axis.cross(through_air);
}

}  // namespace plant
