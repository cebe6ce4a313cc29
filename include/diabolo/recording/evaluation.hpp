// SPDX-License-Identifier: MIT
#pragma once

/// Evaluation of models on recordings: the paper's table, and errors over many starts.

#include "diabolo/recording/excerpt_score.hpp"
#include "diabolo/recording/horizon_score.hpp"
