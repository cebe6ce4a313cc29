// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "geometry.hpp"

namespace plant {

/// An elastic string that rubs around the axle.
struct StringParameters {
  double length = 1.45;       ///< unstretched, tip to tip, at the start [m]
  double creep = 0.0;         ///< its growth per time [m/s]
  double radius = 0.0008;     ///< [m]
  double stiffness = 2000.0;  ///< EA, force per relative stretch [N]
  double stiffening_stretch =
      std::numeric_limits<double>::infinity();  ///< stretch that doubles the stiffness [m]
  double damping = 10.0;                        ///< force per rate of stretch [N s/m]
  double friction = 0.3;                        ///< capstan coefficient of fast slip; of a chain, Coulomb's
  double friction_rise = 0.0;                   ///< added to the coefficient as slip goes to zero (Stribeck)
  double stribeck_speed = 0.1;                  ///< slip speed over which that rise fades [m/s]
  double lay = 0.0;               ///< force along the axle by the string's twist, as a share of its friction
  double slip_scale = 0.01;       ///< slip speed that regularises the sign of friction [m/s]
  double linear_density = 0.0;    ///< of a chain; else only the slack string's weight on the axle [kg/m]
  int segments = 41;              ///< of a chain
  double bending_damping = 4e-7;  ///< of a chain: moment per rate of curvature [N m^2 s]
  double wave_damping = 3.0;      ///< of a chain: rate at which waves across the string die out [1/s]
  int wraps = 0;                  ///< whole turns around the axle beyond the simple pass under it

  /// The string as it is at a time [s]: longer, if it creeps.
  StringParameters at(double time) const {
    StringParameters later = *this;
    later.length += creep * time;
    return later;
  }
};

/// Where the string is asked to lie: the axle, the tips and their motion.
struct StringEnds {
  Vec3 centre = Vec3::Zero();    ///< diabolo's centre of mass [m]
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
  Vec3 axis = Vec3::UnitX();     ///< unit spin axis
  double spin = 0.0;             ///< about `axis` [rad/s]
  Pair<Vec3> tips{};             ///< [m]
  Pair<Vec3> tip_velocities{};   ///< [m/s]
  double chirality = -1.0;       ///< +1 or -1: sense about `axis` in which the string runs from left to right
  double wrap_reference = 0.0;   ///< a recent wrap angle, which tells the number of whole turns [rad]
};

/// Straight piece from the axle to one tip.
struct Strand {
  Vec3 arm = Vec3::Zero();        ///< from the centre of mass to where the strand leaves the axle [m]
  Vec3 direction = Vec3::Zero();  ///< unit vector from there to the tip
  double length = 0.0;            ///< [m]
};

/// The string drawn tight around the axle.
struct StringShape {
  Pair<Strand> strands;
  double wrap = 0.0;      ///< contact angle [rad]
  double arc = 0.0;       ///< length on the axle [m]
  double length = 0.0;    ///< strands and arc [m]
  double rate = 0.0;      ///< its rate of change [m/s]
  double slip = 0.0;      ///< string over axle surface, positive towards the right tip [m/s]
  bool at_flank = false;  ///< pushed against the side of the groove
};

/// Pull of the two strands [N]; negative where the string would have to push.
struct Tensions {
  double left = 0.0;
  double right = 0.0;
};

/// Groove of the axle as the string sees it.
struct Groove {
  double radius = 0.0065;         ///< axle radius [m]
  double profile_radius = 0.005;  ///< radius of the groove's cross-section [m]
  double half_width = 0.005;      ///< furthest that the contact moves along the axis [m]
  double offset = 0.0;            ///< of its middle from the centre of mass, along the axis [m]
};

/// Shape of the taut string. Throws std::domain_error when a tip has come within the axle.
StringShape string_shape(const StringParameters& string, const Groove& groove, const StringEnds& ends);

/// Tensions of the two strands: one stretch, shared out by capstan friction. The string is that of the
/// moment.
Tensions string_tensions(const StringParameters& string, const StringShape& shape);

}  // namespace plant
