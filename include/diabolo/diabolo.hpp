// SPDX-License-Identifier: MIT
#pragma once

// What most programs begin with: prediction, its effects and derivatives, and recordings. It compiles in some
// seconds. Include what takes longer by name: evaluate/evaluation.hpp, plan/player.hpp, robot/,
// json/ (with nlohmann's library), and diagnose/answer.hpp (with diabolo::diagnose) or
// diagnose/diagnosis.hpp.
#include "diabolo/batch/batch.hpp"
#include "diabolo/effects/all.hpp"
#include "diabolo/full_predictor.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/math/pack.hpp"
#include "diabolo/model.hpp"
#include "diabolo/recording/formats/calibration.hpp"
#include "diabolo/recording/formats/motive.hpp"
#include "diabolo/recording/formats/tidy.hpp"
#include "diabolo/rollout.hpp"
#include "diabolo/version.hpp"
