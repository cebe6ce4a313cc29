// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/predictor.hpp"

namespace diabolo {

/// The string that a predictor sees with a state, drawn tight from its tips over the diabolo.
struct TightString {
  Tips<double> tips;  ///< where the strands begin
  double length;      ///< of the string in the strands [m]
  StringPath<double> path;

  template <template <class> class... Effects>
  static TightString around(const Predictor<double, Effects...>& predictor, const State<double>& state,
                            Tips<double> tips) {
    const auto& effects = predictor.effects();
    const auto& parameters = predictor.parameters();
    StringNow<double> string = effects.string(parameters);
    if (effects.moves_tips()) {
      effects.tip_shift(state, tips, parameters).move(tips);
      string = effects.string_at(string, state, tips, parameters);
    }
    return {tips, string.length, StringPath<double>(state.position, tips)};
  }

  /// How far the path is longer than the string [m].
  double excess() const { return path.length() - length; }
};

/// Brings a state that is one of many possible ones to where a string that does not stretch can have it: on
/// the string, with no velocity off it, where the string `pulls`; else not beyond its reach. Points of a
/// Gaussian do not know the constraint (Julier and LaViola, IEEE TSP 2007: project each of them).
template <template <class> class... Effects>
void keep_within_string(const Predictor<double, Effects...>& predictor, State<double>& state,
                        const Tips<double>& tips, bool pulls) {
  constexpr int kTurns = 3;           // of Newton's method, from a few centimetres
  constexpr double kStraight = 0.01;  // squared gradient of a string that leaves no room across
  if (state.string_state == StringState::kFlying) return;
  for (int turn = 1; turn <= kTurns; ++turn) {
    const TightString string = TightString::around(predictor, state, tips);
    const Vector3<double> gradient = string.path.gradient();
    const double square = squared_norm(gradient), excess = string.excess();
    if (square < kStraight || (!pulls && excess <= 0.0)) return;
    state.position = state.position - gradient * (excess / square);
    if (turn < kTurns) continue;
    const double rate =
        string.path.rate(state.velocity, string.tips.left_velocity, string.tips.right_velocity);
    if (pulls || rate > 0.0) state.velocity = without_path_rate(state.velocity, gradient, rate);
  }
}

}  // namespace diabolo
