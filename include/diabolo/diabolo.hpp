// SPDX-License-Identifier: MIT
#pragma once

// Everything that needs the standard library and Eigen only, but for the diagnosis (diagnose/diagnosis.hpp)
// and the robot (robot/), which take long to compile.
#include "diabolo/batch/batch.hpp"
#include "diabolo/effects/all.hpp"
#include "diabolo/evaluate/evaluation.hpp"
#include "diabolo/full_predictor.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/math/pack.hpp"
#include "diabolo/plan/player.hpp"
#include "diabolo/recording/formats/calibration.hpp"
#include "diabolo/recording/formats/motive.hpp"
#include "diabolo/recording/formats/spin_line.hpp"
#include "diabolo/recording/formats/tidy.hpp"
#include "diabolo/recording/plausibility/warnings.hpp"
#include "diabolo/recording/resample.hpp"
#include "diabolo/recording/spin.hpp"
#include "diabolo/recording/velocity.hpp"
#include "diabolo/rollout.hpp"
#include "diabolo/version.hpp"
