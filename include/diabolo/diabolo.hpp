// SPDX-License-Identifier: MIT
#pragma once

// Everything that needs Eigen only.
#include "diabolo/dual.hpp"
#include "diabolo/effects/all.hpp"
#include "diabolo/pack.hpp"
#include "diabolo/rollout.hpp"
#include "diabolo/version.hpp"
