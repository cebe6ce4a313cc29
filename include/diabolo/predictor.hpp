// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>

#include "diabolo/effects/effect.hpp"
#include "diabolo/paper/advance_by_pull.hpp"
#include "diabolo/paper/spin_rule.hpp"
#include "diabolo/paper/step_factors.hpp"
#include "diabolo/string/advance_in_flight.hpp"
#include "diabolo/string/catch_and_release.hpp"
#include "diabolo/string/hold_between_tips.hpp"
#include "diabolo/string/settle_on_string.hpp"
#include "diabolo/string/slide_along_string.hpp"
#include "diabolo/string/taut_string.hpp"
#include "diabolo/string/turn_events.hpp"
#include "diabolo/string/winding.hpp"

namespace diabolo {

/// Predicts the diabolo from the motion of the stick tips. Holds nothing but checked constants: the state is
/// the caller's, and one predictor may serve any number of threads.
///
///     diabolo::Predictor<double> predictor(diabolo::Parameters<double>::consistent());
///     predictor.step(state, tips_now, tips_next, 1e-3);
template <class Scalar, template <class> class... Effects>
class Predictor {
 public:
  using Set = EffectSet<Scalar, Effects...>;

  /// Throws std::invalid_argument where a parameter is out of its range.
  explicit Predictor(const Parameters<Scalar>& parameters, const Set& effects = {})
      : Predictor(parameters, effects, AlreadyValid{}) {
    parameters.validate();
    effects.validate();
  }

  /// For parameters that have been validated before, such as the lanes of a batch.
  struct AlreadyValid {};
  Predictor(const Parameters<Scalar>& parameters, const Set& effects, AlreadyValid)
      : parameters_(parameters), effects_(effects), string_(effects.string(parameters)) {
    plane_.active = parameters.planar;
    plane_.normal = parameters.plane_normal.template cast<Scalar>();
  }

  const Parameters<Scalar>& parameters() const { return parameters_; }
  const Set& effects() const { return effects_; }

  /// Advances the state by `dt` > 0 [s] while the tips move from `begin` to `end`. Never throws, allocates or
  /// prints.
  StepStatus<Scalar> step(State<Scalar>& state, const Tips<Scalar>& begin, const Tips<Scalar>& end,
                          const Scalar& dt) const {
    assert(all(dt > Scalar(0)));
    return parameters_.follow_turns ? step_with_turns(state, begin, end, dt)
                                    : step_with_effects(state, begin, end, dt);
  }

 private:
  static constexpr bool kMayStretch = sizeof...(Effects) > 0;

  [[gnu::noinline]] StepStatus<Scalar> step_with_turns(State<Scalar>& state, const Tips<Scalar>& begin,
                                                       const Tips<Scalar>& end, const Scalar& dt) const {
    count_turns(state, begin, parameters_);
    const State<Scalar> before = state;
    StepStatus<Scalar> status = step_with_effects(state, begin, end, dt);
    count_turns(state, end, parameters_);
    locate_turn(before, state, begin, end, dt, parameters_, status);
    return status;
  }

  [[gnu::always_inline]] inline StepStatus<Scalar> step_with_effects(State<Scalar>& state,
                                                                     const Tips<Scalar>& begin,
                                                                     const Tips<Scalar>& end,
                                                                     const Scalar& dt) const {
    if constexpr (Set::kChangesTips)
      if (effects_.moves_tips()) return step_with_shifted_tips(state, begin, end, dt);
    return dispatch(state, begin, end, dt, string_);
  }

  [[gnu::noinline]] StepStatus<Scalar> step_with_shifted_tips(State<Scalar>& state, Tips<Scalar> begin,
                                                              Tips<Scalar> end, const Scalar& dt) const {
    const TipShift<Scalar> shift = effects_.tip_shift(state, begin, parameters_);
    shift.move(begin);
    shift.move(end);
    const StringNow<Scalar> string = effects_.string_at(string_, state, begin, parameters_);
    if (!elastic(string)) settle_on_string(state, begin, string.length, plane_);
    return dispatch(state, begin, end, dt, string);
  }

  StepStatus<Scalar> dispatch(State<Scalar>& state, const Tips<Scalar>& begin, const Tips<Scalar>& end,
                              const Scalar& dt, const StringNow<Scalar>& string) const {
    if (parameters_.string_law != StringLaw::kInextensible) return pull_step(state, begin, end, dt, string);
    if constexpr (!kManyDerivatives<Scalar>)  // what is in vain half the time costs more than it saves
      if (usual_string_step(state, begin, end, dt, string)) return {};
    return string_step(state, begin, end, dt, string);
  }

  /// string_step() in fewer instructions, bit for bit, while the string stays taut and its turns are not
  /// followed. False where one may not; then the state is as it was.
  bool usual_string_step(State<Scalar>& state, const Tips<Scalar>& begin, const Tips<Scalar>& end,
                         const Scalar& dt, const StringNow<Scalar>& string) const {
    if (parameters_.follow_turns || plane_.active || !all(is(state.string_state, StringState::kOnString)))
      return false;
    const PlaneProjector<Scalar> no_plane;
    const Vector3<Scalar> outer = effects_.acceleration(state, begin, dt, parameters_);
    const StringStep<Scalar> step = step_on(string, state, state.velocity, outer, begin, end, dt, no_plane);
    if (any(step.overstretched())) return false;
    StringStepResult<Scalar> result;
    if (!(elastic(string) ? advance_at_once<true>(step, result) : advance_at_once<false>(step, result)))
      return false;
    take_over(state, step, result);
    return true;
  }

  /// Ours: a massless string that pulls along the bisector of its two segments.
  [[gnu::noinline]] StepStatus<Scalar> string_step(State<Scalar>& state, const Tips<Scalar>& begin,
                                                   const Tips<Scalar>& end, const Scalar& dt,
                                                   const StringNow<Scalar>& string) const {
    StepStatus<Scalar> status;
    const Vector3<Scalar> velocity = plane_(state.velocity);
    const Vector3<Scalar> outer = plane_(effects_.acceleration(state, begin, dt, parameters_));
    const StringStep<Scalar> step = step_on(string, state, velocity, outer, begin, end, dt, plane_);
    const Mask<Scalar> flying = is(state.string_state, StringState::kFlying);
    StringStepResult<Scalar> result =
        any(flying) ? advance_in_flight<kMayStretch>(state, step, parameters_, status.caught)
                    : advance_captured<kMayStretch>(step, !flying);
    if (parameters_.follow_turns) measure_passing(step, result);
    const Mask<Scalar> captured = !is(state.string_state, StringState::kFlying);
    take_over(state, step, result);
    if (!all(result.taut))
      state.string_state =
          slack_string_state(state.string_state, state.position, result.slack, result.gradient_squared,
                             end.left, end.right, is_wound(state, end, parameters_), parameters_);
    status.snapped_taut = result.snapped_taut;
    status.overstretched = step.overstretched();
    if (any(status.overstretched)) hold(state, end, dt, captured && status.overstretched, string);
    return status;
  }

  /// Takes the outcome of the string's step over into the state, with the effects that follow it.
  [[gnu::always_inline]] inline void take_over(State<Scalar>& state, const StringStep<Scalar>& step,
                                               const StringStepResult<Scalar>& result) const {
    const Scalar& dt = step.dt;
    const Scalar passing = side_of_axle(state, parameters_) * result.passed / dt;
    const Scalar slipped =
        spin_after_slip<Scalar>(state.spin, passing, factor_time(parameters_, dt), parameters_);
    Scalar spin =
        effects_.after_torques(select(result.taut, slipped, state.spin), state, step.begin, dt, parameters_);
    Vector3<Scalar> velocity = result.velocity;
    Vector3<Scalar> position = result.position;
    const Mask<Scalar> pulled = result.taut || result.snapped_taut;
    Scalar pull_difference{0};
    if (any(pulled))
      pull_difference = effects_.touch(velocity, spin, state, step.end, result, dt, parameters_);
    if constexpr (Set::kTurnsAxle)
      if (any(pulled) || effects_.tumbles())
        effects_.turn_axle(state, step.end, result, pull_difference, dt, parameters_);
    velocity = step.plane(velocity);
    // The change of velocity happens over the step: the mean of what it was before and after counts.
    if constexpr (Set::kTouches)
      if (any(pulled) && effects_.touches()) {
        const Vector3<Scalar> slid = slide_along_string<Scalar>(
            step, position, (velocity - result.velocity) * Scalar(Scalar(0.5) * dt));
        position = select<Scalar>(pulled, slid, position);
      }
    state.position = step.plane.on(step.position, position);
    state.velocity = velocity * dissipation(parameters_, dt, result.taut);
    state.spin = spin;
    state.string_acceleration = result.string_acceleration;
    assign_where(result.taut, state.string_state, StringState::kOnString);
  }

  /// The paper's and the published program's rules.
  StepStatus<Scalar> pull_step(State<Scalar>& state, const Tips<Scalar>& begin, const Tips<Scalar>& end,
                               const Scalar& dt, const StringNow<Scalar>& string) const {
    const Mask<Scalar> was_on_string = is(state.string_state, StringState::kOnString),
                       was_flying = is(state.string_state, StringState::kFlying);
    const Vector3<Scalar> velocity = plane_(state.velocity);
    const Vector3<Scalar> outer = plane_(effects_.acceleration(state, begin, dt, parameters_));
    const StringStep<Scalar> step = step_on(string, state, velocity, outer, begin, end, dt, plane_);
    const StringStepResult<Scalar> result = advance_by_pull(state.string_state, step, parameters_);
    const Mask<Scalar> passes = parameters_.pull.spin_rule == SpinRule::kLengthChange
                                    ? is(state.string_state, StringState::kOnString)
                                    : result.taut;
    const Scalar change =
        norm<Scalar>(result.position - end.right) - norm<Scalar>(state.position - begin.right);
    const Scalar driven = spin_after_passing(state.spin, change, dt, parameters_);
    state.spin = select(was_on_string && passes, driven, state.spin);
    Scalar spin = effects_.after_torques(state.spin, state, begin, dt, parameters_);
    Vector3<Scalar> rubbed = result.velocity;
    const Scalar pull_difference = effects_.touch(rubbed, spin, state, end, result, dt, parameters_);
    if constexpr (Set::kTurnsAxle) effects_.turn_axle(state, end, result, pull_difference, dt, parameters_);
    state.spin = spin;
    state.velocity = plane_(rubbed);
    state.position = result.position;
    state.string_acceleration = result.string_acceleration;
    StepStatus<Scalar> status;
    // To the last bit as the spheroid sees it, lest a diabolo be neither put back nor held.
    status.overstretched = norm<Scalar>(end.left - end.right) >= string.length;
    const Mask<Scalar> captured = !is(state.string_state, StringState::kFlying);
    status.caught = was_flying && captured;
    if (!parameters_.pull.release_when_overstretched && any(status.overstretched))
      hold(state, end, dt, captured && status.overstretched, string);
    return status;
  }

  /// A step of the given string; refers to all vectors and the plane.
  [[gnu::always_inline]] static inline StringStep<Scalar> step_on(
      const StringNow<Scalar>& string, const State<Scalar>& state, const Vector3<Scalar>& velocity,
      const Vector3<Scalar>& acceleration, const Tips<Scalar>& begin, const Tips<Scalar>& end,
      const Scalar& dt, const PlaneProjector<Scalar>& plane) {
    return {.position = state.position,
            .velocity = velocity,
            .acceleration = acceleration,
            .begin = begin,
            .end = end,
            .dt = dt,
            .string_length = string.length,
            .string_acceleration = state.string_acceleration,
            .compliance = string.compliance,
            .damping_time = string.damping_time,
            .plane = plane,
            .restitution = string.restitution,
            .inertia = string.inertia,
            .resting = select(is(state.string_state, StringState::kOnString), Scalar(0), string.inertia)};
  }

  static bool elastic(const StringNow<Scalar>& string) {
    return kMayStretch && !is_constant_zero(string.compliance);
  }
  /// On a straight string; an elastic one is longer.
  void hold(State<Scalar>& state, const Tips<Scalar>& tips, const Scalar& dt, const Mask<Scalar>& where,
            const StringNow<Scalar>& string) const {
    hold_between_tips<Scalar>(state, tips, dt, where && (string.compliance == Scalar(0)), plane_);
  }

  Parameters<Scalar> parameters_;
  Set effects_;
  StringNow<Scalar> string_;
  PlaneProjector<Scalar> plane_;
};

}  // namespace diabolo
