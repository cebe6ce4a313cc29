// SPDX-License-Identifier: MIT
#pragma once

// Everything that finds motions of the sticks.
#include "diabolo/plan/random_walk.hpp"
#include "diabolo/plan/throw_and_catch.hpp"
