// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/predictor.hpp"

namespace diabolo {

/// Brings a state that is one of many possible ones to where a string that does not stretch can have it: on
/// the string, with no velocity off it, where the string `pulls`; else not beyond its reach. Points of a
/// Gaussian do not know the constraint (Julier and LaViola, IEEE TSP 2007: project each of them).
template <template <class> class... Effects>
void keep_within_string(const Predictor<double, Effects...>& predictor, State<double>& state,
                        const Tips<double>& tips, bool pulls) {
  constexpr int kTurns = 3;          // of Newton's method, from a few centimetres
  constexpr double kStraight = 0.01; // squared gradient of a string with no room across [1]
  if (state.string_state == StringState::kFlying) return;
  const auto& effects = predictor.effects();
  const auto& parameters = predictor.parameters();
  for (int turn = 0; turn < kTurns; ++turn) {
    Tips<double> there = tips;
    StringNow<double> string = effects.string(parameters);
    if (effects.moves_tips()) {
      const TipShift<double> shift = effects.tip_shift(state, tips, parameters);
      there.left += shift.left;
      there.right += shift.right;
      string = effects.string_at(string, state, there, parameters);
    }
    const StringPath<double> path(state.position, there);
    const Vector3<double> gradient = path.gradient();
    const double square = squared_norm(gradient), gap = path.length() - string.length;
    if (square < kStraight || (!pulls && gap <= 0.0)) return;
    state.position = state.position - gradient * (gap / square);
    if (turn + 1 < kTurns) continue;
    const double rate = path.rate(state.velocity, there.left_velocity, there.right_velocity);
    if (pulls || rate > 0.0) state.velocity = without_path_rate(state.velocity, gradient, rate);
  }
}

}  // namespace diabolo
