// SPDX-License-Identifier: MIT
#pragma once

#include "plant.hpp"

namespace plant {

/// The motion with a reach that brings the middle of the string under a diabolo that has just been released;
/// moves `moment` on to where the diabolo has come down, or to `end` [s].
Motion with_catch(const PlantParameters& parameters, const Motion& planned, Moment& moment, double end);

}  // namespace plant
