// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>

#include "scenario.hpp"

namespace plant {

/// Plays on with hands that somebody else moves, from where the scenario begins; its own motion is left
/// aside.
///
/// Each line of `in` is a period: its duration [s] and the accelerations of both hands in it, left x, y, z,
/// right x, y, z [m/s^2]. A line of `out` tells each moment, the first one too: time, mode, position,
/// velocity, spin, left hand, right hand (as of a truth file). It ends with `in`, or where the diabolo misses
/// the string. Throws std::invalid_argument about a line that cannot be read, else what Plant::begin and
/// Plant::advanced throw.
void play_live(const Scenario& scenario, std::istream& in, std::ostream& out);

}  // namespace plant
