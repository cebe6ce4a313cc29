// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <vector>

#include "diabolo/plan/hang_at_rest.hpp"
#include "diabolo/plan/planned_play.hpp"

namespace diabolo {

/// A diabolo that ends farther from where it was planned to is lost [m].
inline constexpr double kLostBy = 0.3;

/// The share of the models by which the diabolo of a planned motion ends on its string, within kLostBy of
/// where it was planned to: how robust the motion is. Throws std::invalid_argument where there are none.
template <template <class> class... Effects>
double success_rate(const PlannedPlay& planned, const std::vector<Predictor<double, Effects...>>& models) {
  if (models.empty()) throw std::invalid_argument("models: none; at least one expected");
  const Vector3<double>& wanted = planned.play.instants.back().state.position;
  int held = 0;
  for (const Predictor<double, Effects...>& model : models) {
    const State<double> end = play(model, planned.start, planned.path, {.dt = kShownStep}).end().state;
    const bool close = (end.position - wanted).norm() < kLostBy;
    if (close && end.string_state != StringState::kFlying) ++held;
  }
  return static_cast<double>(held) / static_cast<double>(models.size());
}

}  // namespace diabolo
