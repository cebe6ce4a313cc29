// SPDX-License-Identifier: MIT
#pragma once

// Everything that needs the standard library and Eigen only.
#include "diabolo/batch.hpp"
#include "diabolo/dual.hpp"
#include "diabolo/effects/all.hpp"
#include "diabolo/pack.hpp"
#include "diabolo/player/player.hpp"
#include "diabolo/predictor_in.hpp"
#include "diabolo/recording/calibration.hpp"
#include "diabolo/recording/evaluation.hpp"
#include "diabolo/recording/motive.hpp"
#include "diabolo/recording/resample.hpp"
#include "diabolo/recording/spin.hpp"
#include "diabolo/recording/tidy.hpp"
#include "diabolo/recording/velocity.hpp"
#include "diabolo/rollout.hpp"
#include "diabolo/version.hpp"
