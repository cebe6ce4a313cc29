// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "string.hpp"

namespace plant {

/// A string as a row of nodes from the left tip to the right one, and how the diabolo lies on it. Segment i
/// joins the nodes i and i + 1.
struct ChainState {
  std::vector<Vec3> places;      ///< of the nodes [m]; empty where the string is no chain
  std::vector<Vec3> velocities;  ///< [m/s]
  std::size_t bight = 0;         ///< segment that lies around the axle, or did so last
  bool touching = false;         ///< whether it does
  double aside = 0.0;  ///< how far beside the groove, along the axis, it still lies after a catch [m]
  Tensions tensions;   ///< on either side of the axle in the last step [N]
  double pull = 0.0;   ///< their mean, smoothed over some milliseconds [N]
  double slip = 0.0;   ///< string over axle surface, positive towards the right tip [m/s]
};

}  // namespace plant
