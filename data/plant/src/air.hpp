// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

#include "geometry.hpp"

namespace plant {

/// What acts on the diabolo's centre and spin from outside; u is the diabolo's velocity through the air.
struct AirParameters {
  double linear_drag = 0.0;         ///< acceleration per speed, against u [1/s]
  double drag = 0.028;              ///< acceleration per speed squared, against u [1/m]
  double drag_power = 2.0;          ///< of the speed in `drag`, which does the same at 2 m/s by all powers
  double constant_drag = 0.0;       ///< acceleration against u whatever its size [m/s^2]
  double magnus = 0.0011;           ///< acceleration per spin and speed, along axis x u [1/rad]
  Vec3 wind = Vec3::Zero();         ///< velocity of the air, world frame [m/s]
  double tip_wake = 0.0;            ///< acceleration per mean velocity of the two tips [1/s]
  double pull = 0.0;                ///< acceleration per distance, towards `pull_centre` [1/s^2]
  Vec3 pull_centre = Vec3::Zero();  ///< world frame [m]
  Vec3 gust = Vec3::Zero();         ///< amplitude of an acceleration that comes and goes [m/s^2]
  double spin_gust = 0.0;           ///< the same of the spin about the axis [rad/s^2]
  double gust_frequency = 0.0;      ///< of both [Hz]
  double gust_phase = 0.0;          ///< of both at the start [rad]
  double windage = 3e-8;            ///< torque per spin squared, against the spin [N m s^2/rad^2]
  double windage_power = 2.0;  ///< of the spin in `windage`, which does the same at 100 rad/s by all powers
};

/// Where, when and how fast the diabolo meets the air.
struct Meeting {
  double time = 0.0;                  ///< since the start [s]
  Vec3 position = Vec3::Zero();       ///< [m]
  Vec3 velocity = Vec3::Zero();       ///< [m/s]
  Vec3 axis = Vec3::UnitX();          ///< unit spin axis
  double spin = 0.0;                  ///< about `axis` [rad/s]
  Vec3 tips_velocity = Vec3::Zero();  ///< mean of the two tips [m/s]
};

inline constexpr double kRestingSpeed = 0.05;    ///< below it a drag of constant size fades away [m/s]
inline constexpr double kReferenceSpeed = 2.0;   ///< where drags of all powers meet [m/s]
inline constexpr double kReferenceSpin = 100.0;  ///< where windages of all powers meet [rad/s]

/// Direction of a velocity [m/s]; a shorter vector near rest.
inline Vec3 heading(const Vec3& velocity) {
  const double speed = velocity.norm();
  return (speed > 0.0 ? std::tanh(speed / kRestingSpeed) / speed : 1.0 / kRestingSpeed) * velocity;
}

/// What stands in the square's place for another power of a size, as large as the square at `reference`.
inline double raised(double size, double power, double reference) {
  return reference * reference * std::pow(size / reference, power);
}

/// How much of the gusts there is at a time [s], from -1 to 1.
inline double gust_share(const AirParameters& air, double time) {
  return std::sin(2.0 * std::numbers::pi * air.gust_frequency * time + air.gust_phase);
}

/// Acceleration [m/s^2] of the centre of mass.
inline Vec3 air_acceleration(const AirParameters& air, const Meeting& meeting) {
  const Vec3 through_air = meeting.velocity - air.wind;
  const double speed = through_air.norm();
  const bool is_square = air.drag_power == 2.0 || !(speed > 0.0);
  const double growth = is_square ? speed : raised(speed, air.drag_power, kReferenceSpeed) / speed;
  const Vec3 drag = -(air.linear_drag + air.drag * growth) * through_air;
  return drag + air.magnus * meeting.spin * meeting.axis.cross(through_air) -
         air.constant_drag * heading(through_air) + air.tip_wake * meeting.tips_velocity +
         air.pull * (air.pull_centre - meeting.position) + gust_share(air, meeting.time) * air.gust;
}

}  // namespace plant
