// SPDX-License-Identifier: MIT
#pragma once

#include "string.hpp"

namespace plant {

/// The axle as the segment around it meets it.
struct Axle {
  Vec3 centre = Vec3::Zero();  ///< diabolo's centre of mass [m]
  Vec3 axis = Vec3::UnitX();   ///< unit spin axis
  double chirality = -1.0;     ///< +1 or -1: sense about `axis` in which the string runs from left to right
  double aside = 0.0;          ///< how far beside its place in the groove the string lies, along the axis [m]
};

/// A segment drawn around the axle: straight to the left node, an arc, straight to the right node.
struct Bight {
  Pair<Vec3> arms{};         ///< from the centre of mass to where the straight pieces leave the axle [m]
  Pair<Vec3> directions{};   ///< unit vectors from there to the nodes
  Pair<double> straights{};  ///< lengths of the straight pieces [m]
  double wrap = 0.0;         ///< angle of the arc, within a quarter turn less than none and three more [rad]
  double arc = 0.0;          ///< its length [m]

  double length() const { return straights[0] + arc + straights[1]; }
};

/// The bight between two nodes; a node within the axle counts as one on its surface.
Bight bight_around(const Axle& axle, const Groove& groove, double contact_radius, const Pair<Vec3>& nodes);

}  // namespace plant
