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

/// The start of the authors' program at a row: the diabolo where it is, the velocity from this row and the
/// next, the spin between them, the string loose. Both rows must be valid. A spin that is not known is zero.
inline State<double> published_start(const Recording& recording, Eigen::Index row, bool signed_rule) {
  State<double> state;
  state.position = recording.diabolo.position.col(row);
  state.velocity = (recording.diabolo.position.col(row + 1) - state.position) * recording.rate;
  const Spin spin = signed_rule ? signed_spin(recording) : unsigned_spin(recording);
  if (spin.valid[row]) state.spin = spin.value[row];
  state.string_state = StringState::kLoose;
  return state;
}

}  // namespace diabolo
