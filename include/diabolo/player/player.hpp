// SPDX-License-Identifier: MIT
#pragma once

// Everything that finds motions of the sticks.
#include "diabolo/player/random_walk.hpp"
#include "diabolo/player/throw_and_catch.hpp"
