// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "diabolo/effects/stick_flex.hpp"
#include "diabolo/effects/string_elasticity.hpp"
#include "diabolo/evaluate/start_noise.hpp"
#include "diabolo/math/scalar.hpp"
#include "diabolo/predictor.hpp"
#include "diabolo/rules.hpp"
#include "diabolo/state.hpp"
#include "diabolo/string/string_path.hpp"

namespace diabolo {

/// From such springs on [m/N] a bounce is so slow and wide that a start shows it. On stiffer ones it drowns
/// in the noise of a camera, and a start is better at rest on them: 0.4 mm of noise are four times what a
/// diabolo of 0.2 kg stretches a string of 1e-4 m/N by.
inline constexpr double kBouncyString = 0.012;

/// A start is where the string has it at rest but for its noise, where it is off by no more than so many
/// standard deviations; else it is caught or leaves.
inline constexpr double kWithinNoise = 4.0;

/// How far the string gives under a tension, in itself and at both tips [m/N].
template <class Effects>
double give_of(const Effects& effects) {
  return value_of(effects.template get<StringElasticity>().compliance_per_newton) +
         2.0 * value_of(effects.template get<StickFlex>().compliance);
}

/// The string of a state; moves the tips to where its strands begin.
template <class Scalar, template <class> class... Effects>
StringNow<Scalar> string_from(Tips<Scalar>& tips, const State<Scalar>& state,
                              const Predictor<Scalar, Effects...>& predictor) {
  const auto& effects = predictor.effects();
  const auto& parameters = predictor.parameters();
  effects.tip_shift(state, tips, parameters).move(tips);
  return effects.string_at(effects.string(parameters), state, tips, parameters);
}

/// Moves a start ON_STRING to where the taut string allows it under the pull tension/mass [m/s^2]: path
/// length and its rate.
template <class Scalar, template <class> class... Effects>
void place_on_string(State<Scalar>& state, Tips<Scalar> tips, const Scalar& pull,
                     const Predictor<Scalar, Effects...>& predictor) {
  const StringNow<Scalar> string = string_from(tips, state, predictor);
  const Scalar length = string.length + string.compliance * pull;
  for (int i = 0; i < 3; ++i) {
    const StringPath<Scalar> path(state.position, tips);
    const Vector3<Scalar> gradient = path.gradient();
    state.position = state.position -
                     gradient * Scalar((path.length() - length) / (squared_norm(gradient) + Scalar(1e-6)));
  }
  const StringPath<Scalar> path(state.position, tips);
  const Vector3<Scalar> gradient = path.gradient();
  const Scalar rate = path.rate(state.velocity, tips.left_velocity, tips.right_velocity);
  state.velocity = state.velocity - gradient * Scalar(rate / (squared_norm(gradient) + Scalar(1e-6)));
}

/// The predictor with a string and sticks that give nothing; none where they do not anyway, or where a spring
/// is not in its string's law.
template <class Scalar, template <class> class... Effects>
std::optional<Predictor<Scalar, Effects...>> without_springs(const Predictor<Scalar, Effects...>& predictor) {
  using Result = Predictor<Scalar, Effects...>;
  const auto& effects = predictor.effects();
  if ((effects.template get<StringElasticity>().neutral() && effects.template get<StickFlex>().neutral()) ||
      predictor.parameters().string_law != StringLaw::kInextensible)
    return std::nullopt;
  typename Result::Set stiff = effects;
  stiff.template get<StringElasticity>() = {};
  stiff.template get<StickFlex>() = {};
  return Result(predictor.parameters(), stiff, typename Result::AlreadyValid{});
}

/// The pull tension/mass [m/s^2] of a rigid string in its first step from a state on it, which takes its
/// acceleration down.
template <class Scalar, template <class> class... Effects>
Scalar rigid_pull(State<Scalar>& state, const Predictor<Scalar, Effects...>& rigid, const Tips<Scalar>& tips,
                  const Tips<Scalar>& next, const Scalar& dt) {
  State<Scalar> trial = state;
  rigid.step(trial, tips, next, dt);
  state.string_acceleration = trial.string_acceleration;
  return norm(trial.string_acceleration) /
         (norm(StringPath<Scalar>(state.position, tips).gradient()) + Scalar(1e-6));
}

/// Whether there is room for a string of this length between the tips.
template <class Scalar>
bool has_room(const Tips<Scalar>& tips, const Scalar& length) {
  return (tips.left - tips.right).squaredNorm() < length * length * Scalar(0.999);
}

/// Fair starts ON_STRING by a model whose string or sticks give, but do not bounce visibly: at rest on them,
/// stretched by the pull of a rigid string, where they are seen there within the noise of starts. As it is
/// seen a start would ring by that noise alone, slack half of the time.
template <class Predicting>
class StartsOnSpring {
 public:
  StartsOnSpring(const Predicting& predictor, const Recording& recording) {
    if (give_of(predictor.effects()) < kBouncyString) rigid_ = without_springs(predictor);
    if (rigid_) noise_ = start_noise(recording);
  }

  /// The first step goes from `begin` [s] for `dt` [s].
  template <class Motion>
  void place(State<double>& state, const Predicting& predictor, const Motion& motion, double begin,
             double dt) const {
    if (!rigid_ || state.string_state != StringState::kOnString) return;
    const Tips<double> tips = motion.at(begin);
    Tips<double> ends = tips;
    if (!has_room(ends, string_from(ends, state, predictor).length)) return;
    State<double> rests = state;
    place_on_string(rests, tips, 0.0, predictor);
    const double pull = rigid_pull(rests, *rigid_, tips, motion.at(begin + dt), dt);
    place_on_string(rests, tips, pull, predictor);
    if ((rests.position - state.position).norm() > kWithinNoise * noise_.position ||
        (rests.velocity - state.velocity).norm() > kWithinNoise * noise_.velocity)
      return;
    state = rests;
  }

 private:
  std::optional<Predicting> rigid_;
  StartNoise noise_;
};

}  // namespace diabolo
