// SPDX-License-Identifier: MIT
#pragma once

// What most programs begin with: prediction, its effects and derivatives. It compiles in some seconds.
// Include what takes longer by name: recording/formats/, evaluate/evaluation.hpp, plan/player.hpp, robot/,
// json/ (with nlohmann's library; json/recording_file.hpp reads a recording of any format), and
// diagnose/answer.hpp (with diabolo::diagnose) or diagnose/diagnosis.hpp.
#include "diabolo/batch/batch.hpp"
#include "diabolo/effects/all.hpp"
#include "diabolo/full_predictor.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/math/pack.hpp"
#include "diabolo/model.hpp"
#include "diabolo/rollout.hpp"
#include "diabolo/version.hpp"
