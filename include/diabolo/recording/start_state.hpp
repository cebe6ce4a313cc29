// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/recording/recording.hpp"
#include "diabolo/recording/spin.hpp"
#include "diabolo/recording/velocity.hpp"
#include "diabolo/state.hpp"

namespace diabolo {

/// How the state at the start of a prediction is found.
enum class Start {
  kFair,       ///< from frames at or before the start only; the same for every model
  kPublished,  ///< the authors' program: velocity from the start and the frame after it, string loose
};

}  // namespace diabolo
