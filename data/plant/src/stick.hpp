// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "state.hpp"

namespace plant {

/// The part of a stick beyond what the cameras track: a small mass on a spring across the stick.
struct StickParameters {
  std::optional<double> bending_stiffness = 250.0;  ///< [N/m]; none: rigid
  double tip_mass = 0.01;                           ///< [kg]
  double damping_ratio = 0.05;
};

/// Second derivative of the bend [m/s^2]. The spring acts along the stick as well, which only holds the bend
/// across it while the stick turns; `pull` is the string's force on the tip [N].
inline Vec3 bend_acceleration(const StickParameters& parameters, const Stick& stick, const Vec3& bend,
                              const Vec3& bend_rate, const Vec3& pull, const Vec3& gravity) {
  const double stiffness = *parameters.bending_stiffness;
  const double mass = parameters.tip_mass;
  const double damping = 2.0 * parameters.damping_ratio * std::sqrt(stiffness * mass);
  const Vec3 load = pull - mass * (stick.acceleration - gravity);
  return (perpendicular_part(load, stick.direction) - stiffness * bend - damping * bend_rate) / mass;
}

}  // namespace plant
