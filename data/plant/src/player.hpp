// SPDX-License-Identifier: MIT
#pragma once

#include "plant.hpp"

namespace plant {

/// What a player who watches the diabolo adds to the planned motion of the hands.
struct Player {
  bool catches = false;  ///< reaches aside to bring the middle of the string under a diabolo that comes down
  bool steers = false;   ///< sets one hand forward and the other back to keep the axis level and forward
};

/// The planned motion with what the player adds. Nothing is added before its reason is seen. Throws what
/// `Plant::begin` and `Plant::advanced` throw.
Motion played_by(const Player& player, const PlantParameters& parameters, const Start& start,
                 const Motion& planned, double duration);

}  // namespace plant
