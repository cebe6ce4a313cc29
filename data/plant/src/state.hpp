// SPDX-License-Identifier: MIT
#pragma once

#include "geometry.hpp"

namespace plant {

/// What the integrator carries, one quantity per column, world frame, SI units. The fast spin is kept in one
/// phase angle beside a slow frame (axis, reference), so that the step need not resolve the rotation of a
/// marker.
using State = Eigen::Matrix<double, 3, 10>;

/// Columns of `State`.
enum Column : int {
  kPosition,         ///< centre of mass [m]
  kVelocity,         ///< [m/s]
  kAngularMomentum,  ///< about the centre of mass [kg m^2/s]
  kAxis,             ///< unit spin axis, forward at the start of play
  kReference,        ///< unit vector across the axis, carried along without spinning
  kPhase,            ///< first row: angle of the body about the axis from `kReference` [rad]
  kLeftBend,         ///< left tip minus where a rigid stick's would be [m]
  kRightBend,        ///< the same at the right [m]
  kLeftBendRate,     ///< [m/s]
  kRightBendRate,    ///< [m/s]
};

inline constexpr Pair<int> kBend{kLeftBend, kRightBend};
inline constexpr Pair<int> kBendRate{kLeftBendRate, kRightBendRate};

/// How the diabolo and the string meet.
enum class Mode {
  kOnString,  ///< string taut under the axle
  kLoose,     ///< string under the axle but slack: free fall
  kFlying,    ///< off the string
};

inline const char* mode_name(Mode mode) {
  return mode == Mode::kOnString ? "ON_STRING" : mode == Mode::kLoose ? "LOOSE" : "FLYING";
}

/// Where one stick is and how it moves, as driven by the hand: the tip that a rigid stick would have.
struct Stick {
  Vec3 tip = Vec3::Zero();           ///< [m]
  Vec3 velocity = Vec3::Zero();      ///< [m/s]
  Vec3 acceleration = Vec3::Zero();  ///< [m/s^2]
  Vec3 direction = Vec3::UnitX();    ///< unit vector along the stick, outwards
};

}  // namespace plant
