// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/plan/play.hpp"
#include "diabolo/plan/stick_spline.hpp"
#include "diabolo/string/hanging.hpp"

namespace diabolo {

/// Step of what is shown of a plan [s].
inline constexpr double kShownStep = 1e-3;

/// The diabolo at rest below resting tips (left over right [m]), where the model lets it hang: friction leans
/// it to the side, and what gives lowers it. It is let go, and stopped again, until it stays. `spin` [rad/s];
/// `sticks` as in StickSpline. Throws std::invalid_argument where a number is not one of play.
template <template <class> class... Effects>
State<double> hang_at_rest(const Predictor<double, Effects...>& model, const TipColumn<double>& tips,
                           double spin, const TipColumn<double>& sticks = TipColumn<double>::Zero()) {
  constexpr double kLetGo = 0.15, kStays = 1e-6;  // [s], [m]
  constexpr int kMostTimes = 60;
  StickSpline<double> rest;
  rest.points = {tips, tips};
  rest.durations = {kLetGo};
  rest.sticks = sticks;
  rest.validate();
  const TipPath<double> path = path_of(rest);
  State<double> state = hanging_state(Vector3<double>(tips.head<3>()), Vector3<double>(tips.tail<3>()),
                                      model.parameters().string_length, spin);
  for (int i = 0; i < kMostTimes; ++i) {
    check_state("start", state);
    const Vector3<double> before = state.position;
    state.position = play(model, state, path, {.dt = kShownStep}).end().state.position;
    if ((state.position - before).norm() < kStays) break;
  }
  return state;
}

}  // namespace diabolo
