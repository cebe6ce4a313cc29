// SPDX-License-Identifier: MIT
#pragma once

// Everything that needs the standard library and Eigen only, but for the diagnosis (diagnose/diagnosis.hpp)
// and the robot (robot/), which take long to compile.
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
#include "diabolo/recording/spin_line.hpp"
#include "diabolo/recording/tidy.hpp"
#include "diabolo/recording/velocity.hpp"
#include "diabolo/recording/warnings.hpp"
#include "diabolo/rollout.hpp"
#include "diabolo/version.hpp"
