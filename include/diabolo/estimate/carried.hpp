// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/strand_tensions.hpp"

// Steps of a diabolo that goes by measured tensions of its strands [N], left and right, and not by the
// predictor's string. Gravity, air and what a difference of tensions does to the spin are the predictor's.
namespace diabolo {

/// The spin after a step in which the measured tensions turned the axle: that of the predictor's friction,
/// scaled from its difference of tensions to the measured one.
template <template <class> class... Effects>
double spin_by_tensions(const Predictor<double, Effects...>& predictor, const State<double>& before,
                        const State<double>& after, const Tips<double>& begin, const Tips<double>& end,
                        double dt, double left, double right) {
  const auto& effects = predictor.effects();
  const auto& parameters = predictor.parameters();
  const Strands<double> strands = pulling_strands(predictor, before, after, begin, end);
  StringStepResult<double> pull;
  pull.position = after.position;
  pull.velocity = after.velocity;
  pull.string_acceleration = (strands.left * left + strands.right * right) * (1.0 / parameters.mass);
  pull.passed = 0.5 * (StringPath<double>(after.position, end).imbalance() -
                       StringPath<double>(before.position, begin).imbalance());
  pull.taut = true;
  const double slipped =
      spin_after_slip<double>(before.spin, pull.passed / dt, factor_time(parameters, dt), parameters);
  const double free = effects.after_torques(slipped, before, begin, dt, parameters);
  double spin = free;
  Vector3<double> rubbed = after.velocity;  // what friction does to it is in the tensions
  const double difference = effects.touch(rubbed, spin, before, end, pull, dt, parameters);
  if (difference == 0.0) return spin;
  return free + (spin - free) * (right - left) / (parameters.mass * difference);
}

/// Along a taut string, where friction leans the pull: what the measured difference of tensions is beyond the
/// predictor's, `excess` [N], right less left.
inline void lean_by_tensions(State<double>& state, const Strands<double>& strands, double mass, double excess,
                             double dt) {
  const Vector3<double> change = (strands.right - strands.left) * (0.5 * excess * dt / mass);
  state.position = state.position + change * (0.5 * dt);
  state.velocity = state.velocity + change;
}

/// What a string does that gives and bounces.
template <template <class> class... Effects>
void carry_by_tensions(const Predictor<double, Effects...>& predictor, State<double>& state,
                       const Tips<double>& begin, double dt, double left, double right) {
  const auto& parameters = predictor.parameters();
  const Strands<double> strands = pulling_strands(predictor, state, state, begin, begin);
  state.string_acceleration = (strands.left * left + strands.right * right) * (1.0 / parameters.mass);
  const Vector3<double> acceleration =
      predictor.effects().acceleration(state, begin, dt, parameters) + state.string_acceleration;
  state.position = state.position + state.velocity * dt + acceleration * (0.5 * dt * dt);
  state.velocity = state.velocity + acceleration * dt;
  if constexpr (EffectSet<double, Effects...>::kTurnsAxle) {
    StringStepResult<double> pull;
    pull.position = state.position;
    pull.string_acceleration = state.string_acceleration;
    pull.taut = true;
    predictor.effects().turn_axle(state, begin, pull, (right - left) / parameters.mass, dt, parameters);
  }
}

}  // namespace diabolo
