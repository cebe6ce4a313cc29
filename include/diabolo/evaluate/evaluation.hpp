// SPDX-License-Identifier: MIT
#pragma once

/// Evaluation of models on recordings: the paper's table, and errors over many starts.

#include "diabolo/evaluate/excerpt_score.hpp"
#include "diabolo/evaluate/horizon_score.hpp"
