// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "string.hpp"

namespace plant {

/// What follows from the string's parameters once it is cut into segments. A piece of constant length that
/// covers the arc on the axle and a little more belongs to whichever segment lies there: nodes go round the
/// axle in one leap of that length, so that none comes so near that the step would be too long for it.
struct ChainMeasures {
  double contact_radius;  ///< from the spin axis to the string's middle [m]
  double patch;           ///< length of that piece [m]
  double spacing;         ///< length of a segment, unstretched and without the piece [m]
  double node_mass;       ///< [kg]

  ChainMeasures(const StringParameters& string, const Groove& groove)
      : contact_radius(groove.radius + string.radius),
        patch(std::numbers::pi * contact_radius + 2.0 * kClearance),
        spacing((string.length - patch) / string.segments),
        node_mass(string.linear_density * string.length / string.segments),
        last_(string.segments - 1) {}

  /// Unstretched length of a segment [m].
  double rest(bool is_bight) const { return is_bight ? spacing + patch : spacing; }

  /// How much string lies between the left tip and a node [m].
  double coordinate(std::size_t node, std::size_t bight) const {
    return spacing * static_cast<double>(node) + (node > bight ? patch : 0.0);
  }

  /// The segment that is to hold the patch where the axle lies so far along the string [m].
  std::size_t bight_at(double coordinate) const {
    const double before = std::floor((coordinate - 0.5 * patch) / spacing);
    return static_cast<std::size_t>(std::clamp(before, 0.0, static_cast<double>(last_)));
  }

 private:
  static constexpr double kClearance = 0.003;  // free strand that a node leaves when it goes round [m]
  int last_;
};

}  // namespace plant
