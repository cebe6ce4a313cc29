// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "air.hpp"
#include "spin_loss.hpp"
#include "state.hpp"
#include "string.hpp"

namespace plant {

/// A rigid body of revolution.
struct DiaboloParameters {
  double mass = 0.2893;           ///< [kg]
  double diameter = 0.127;        ///< of the cups [m]
  double length = 0.143;          ///< along the axis [m]
  double axial_inertia = 5.6e-4;  ///< [kg m^2]
  double inertia_ratio = 1.18;    ///< transverse over axial inertia
  Groove groove;
  std::optional<double>
      bearing_torque;           ///< drag of a one-way bearing in its free sense [N m]; none: fixed axle
  double axle_drag = 0.0;       ///< constant deceleration of the spin [rad/s^2]
  double tension_drag = 0.0;    ///< deceleration of the centre per mean tension of the string [m/s^2/N]
  double flank_friction = 0.0;  ///< coefficient of the string against a cup's flank
  double flank_radius = 0.012;  ///< radius at which it rubs there [m]
};

/// Spin about the body's axis [rad/s]; play's own sign is the opposite one (see `play_spin`).
inline double spin_about_axis(const DiaboloParameters& diabolo, const State& state) {
  return state.col(kAngularMomentum).dot(state.col(kAxis)) / diabolo.axial_inertia;
}

/// Spin as players count it: positive when the axle's surface under the string moves towards the right tip.
inline double play_spin(const DiaboloParameters& diabolo, const State& state) {
  return -spin_about_axis(diabolo, state);
}

/// Rotation of body to world: body x is the axis.
inline Eigen::Matrix3d orientation(const State& state) {
  Eigen::Matrix3d rotation;
  rotation.col(0) = state.col(kAxis);
  rotation.col(1) = rotate_in_plane(state.col(kReference), state.col(kAxis), state(0, kPhase));
  rotation.col(2) = rotation.col(0).cross(rotation.col(1));
  return rotation;
}

/// What a one-way bearing leaves of the two tensions: it lets the axle slip under the cups that run ahead of
/// it.
inline Tensions bearing_limited(const DiaboloParameters& diabolo, const StringParameters& string,
                                double chirality, double spin, const Tensions& tensions) {
  const double difference = tensions.right - tensions.left;
  const bool slows = chirality * difference * spin < 0.0;
  if (!diabolo.bearing_torque || !slows) return tensions;
  const double limit = *diabolo.bearing_torque / (diabolo.groove.radius + string.radius);
  const double kept = std::copysign(std::min(std::abs(difference), limit), difference);
  const double mean = 0.5 * (tensions.left + tensions.right);
  return {mean - 0.5 * kept, mean + 0.5 * kept};
}

/// How the diabolo meets the air at a time [s], where the tips move at a mean velocity [m/s].
inline Meeting meeting(const DiaboloParameters& diabolo, const State& state, double time,
                       const Vec3& tips_velocity) {
  return {time,
          state.col(kPosition),
          state.col(kVelocity),
          state.col(kAxis),
          spin_about_axis(diabolo, state),
          tips_velocity};
}

/// Adds what air and bearing do, whether on the string or off it, to a rate of state.
inline void add_drags(const DiaboloParameters& diabolo, const AirParameters& air, const Meeting& met,
                      State& rate) {
  rate.col(kVelocity) += air_acceleration(air, met);
  rate.col(kAngularMomentum) += windage_torque(air, met.spin) * met.axis;
  rate.col(kAngularMomentum) += axle_torque(diabolo.axle_drag, diabolo.axial_inertia, met.spin) * met.axis;
  rate.col(kAngularMomentum) += gust_torque(air, diabolo.axial_inertia, met.time) * met.axis;
}

/// Adds the string's pull to a rate of state; `twisted` times its friction pushes along `axis` beside.
inline void add_string_pull(const DiaboloParameters& diabolo, const StringShape& shape,
                            const Tensions& tensions, double twisted, const State& state, State& rate) {
  const Vec3 axis = state.col(kAxis);
  const Vec3 left = tensions.left * shape.strands[0].direction;
  const Vec3 right = tensions.right * shape.strands[1].direction;
  const Vec3 force = left + right;
  rate.col(kVelocity) += force / diabolo.mass;
  const double mean = 0.5 * (tensions.left + tensions.right);
  rate.col(kVelocity) -= diabolo.tension_drag * mean * heading(state.col(kVelocity));
  rate.col(kAngularMomentum) += shape.strands[0].arm.cross(left) + shape.strands[1].arm.cross(right);
  const Vec3 along = twisted * (tensions.right - tensions.left) * axis;
  rate.col(kVelocity) += along / diabolo.mass;
  rate.col(kAngularMomentum) += 0.5 * (shape.strands[0].arm + shape.strands[1].arm).cross(along);
  if (shape.at_flank) {
    const double brake = diabolo.flank_friction * std::abs(force.dot(axis)) * diabolo.flank_radius;
    rate.col(kAngularMomentum) -= std::copysign(brake, spin_about_axis(diabolo, state)) * axis;
  }
}

/// Adds the motion of a free symmetric top: angular momentum carries the axis and the slow frame.
inline void add_rotation(const DiaboloParameters& diabolo, const State& state, State& rate) {
  const double transverse = diabolo.axial_inertia * diabolo.inertia_ratio;
  const Vec3 slow = perpendicular_part(state.col(kAngularMomentum), state.col(kAxis)) / transverse;
  rate.col(kAxis) += slow.cross(state.col(kAxis));
  rate.col(kReference) += slow.cross(state.col(kReference));
  rate(0, kPhase) += spin_about_axis(diabolo, state);
}

}  // namespace plant
