// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>

#include "diabolo/advance_in_flight.hpp"
#include "diabolo/effects/effect.hpp"
#include "diabolo/hold_between_tips.hpp"
#include "diabolo/pull_velocity.hpp"
#include "diabolo/rotation.hpp"
#include "diabolo/settle_on_string.hpp"
#include "diabolo/slide_along_string.hpp"
#include "diabolo/spheroid.hpp"
#include "diabolo/state_machine.hpp"
#include "diabolo/taut_string.hpp"

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
    if constexpr (Set::kChangesTips)
      if (effects_.moves_tips()) return step_with_shifted_tips(state, begin, end, dt);
    return dispatch(state, begin, end, dt, string_);
  }

 private:
  static constexpr bool kMayStretch = sizeof...(Effects) > 0;

  [[gnu::noinline]] StepStatus<Scalar> step_with_shifted_tips(State<Scalar>& state, Tips<Scalar> begin,
                                                              Tips<Scalar> end, const Scalar& dt) const {
    const TipShift<Scalar> shift = effects_.tip_shift(state, begin, parameters_);
    begin.left += shift.left;
    begin.right += shift.right;
    end.left += shift.left;
    end.right += shift.right;
    const StringNow<Scalar> string = effects_.string_at(string_, state, begin, parameters_);
    if (!elastic(string)) settle_on_string(state, begin, string.length);
    return dispatch(state, begin, end, dt, string);
  }

  StepStatus<Scalar> dispatch(State<Scalar>& state, const Tips<Scalar>& begin, const Tips<Scalar>& end,
                              const Scalar& dt, const StringNow<Scalar>& string) const {
    if (parameters_.string_law != StringLaw::kInextensible) return pull_step(state, begin, end, dt, string);
    if constexpr (ScalarTraits<Scalar>::kLanes == 1)
      if (usual_string_step(state, begin, end, dt, string)) return {};
    return string_step(state, begin, end, dt, string);
  }

  /// Time that the per-step factors stand for.
  Scalar factor_time(const Scalar& dt) const {
    return parameters_.per_step ? parameters_.reference_step : dt;
  }

  /// string_step() in fewer instructions, bit for bit, while the string stays taut. False where it may not;
  /// then the state is as it was.
  bool usual_string_step(State<Scalar>& state, const Tips<Scalar>& begin, const Tips<Scalar>& end,
                         const Scalar& dt, const StringNow<Scalar>& string) const {
    if (state.string_state != StringState::kOnString || plane_.active || overstretched(end, string.length))
      return false;
    const PlaneProjector<Scalar> no_plane;
    const Vector3<Scalar> outer = effects_.acceleration(state, begin, parameters_);
    const StringStep<Scalar> step{state.position,
                                  state.velocity,
                                  outer,
                                  begin,
                                  end,
                                  dt,
                                  string.length,
                                  state.string_acceleration,
                                  string.compliance,
                                  string.damping_time,
                                  no_plane};
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
    const Vector3<Scalar> outer = plane_(effects_.acceleration(state, begin, parameters_));
    const StringStep<Scalar> step{state.position,
                                  velocity,
                                  outer,
                                  begin,
                                  end,
                                  dt,
                                  string.length,
                                  state.string_acceleration,
                                  string.compliance,
                                  string.damping_time,
                                  plane_};
    const Mask<Scalar> flying = is(state.string_state, StringState::kFlying);
    const StringStepResult<Scalar> result =
        any(flying) ? advance_in_flight<kMayStretch>(state, step, parameters_, status.caught)
                    : advance_captured<kMayStretch>(step, !flying);
    const Mask<Scalar> captured = !is(state.string_state, StringState::kFlying);
    take_over(state, step, result);
    if (!all(result.taut))
      state.string_state = slack_string_state(state.string_state, state.position, result.slack,
                                              result.gradient_squared, end.left, end.right, parameters_);
    status.snapped_taut = result.snapped_taut;
    status.overstretched = overstretched(end, string.length);
    if (any(status.overstretched)) hold(state, end, dt, captured && status.overstretched, string);
    return status;
  }

  /// Takes the outcome of the string's step over into the state, with the effects that follow it.
  [[gnu::always_inline]] inline void take_over(State<Scalar>& state, const StringStep<Scalar>& step,
                                               const StringStepResult<Scalar>& result) const {
    const Scalar& dt = step.dt;
    const Scalar slipped =
        spin_after_slip<Scalar>(state.spin, result.passed / dt, factor_time(dt), parameters_);
    Scalar spin = effects_.after_torques(select(result.taut, slipped, state.spin), state, dt, parameters_);
    Vector3<Scalar> velocity = result.velocity;
    effects_.touch(velocity, spin, state, step.end, result, dt, parameters_);
    velocity = step.plane(velocity);
    state.position = result.position;
    // The change of velocity happens over the step: the mean of what it was before and after counts.
    if constexpr (Set::kTouches)
      if (effects_.touches())
        state.position = slide_along_string<Scalar>(step, result.position,
                                                    (velocity - result.velocity) * Scalar(Scalar(0.5) * dt));
    state.velocity = velocity * dissipation(dt, result.taut);
    state.spin = spin;
    state.string_acceleration = result.string_acceleration;
    assign_where(result.taut, state.string_state, StringState::kOnString);
  }

  static Mask<Scalar> overstretched(const Tips<Scalar>& tips, const Scalar& length) {
    return squared_norm<Scalar>(tips.left - tips.right) >= length * length;
  }

  /// The paper's and the published program's: back onto the spheroid, and a capped part of the way as
  /// velocity.
  StepStatus<Scalar> pull_step(State<Scalar>& state, const Tips<Scalar>& begin, const Tips<Scalar>& end,
                               const Scalar& dt, const StringNow<Scalar>& string) const {
    const Parameters<Scalar>& p = parameters_;
    StepStatus<Scalar> status;
    const Mask<Scalar> was_on_string = is(state.string_state, StringState::kOnString);
    const Vector3<Scalar> a = plane_(effects_.acceleration(state, begin, parameters_));
    const Vector3<Scalar> from = state.position;
    Vector3<Scalar> velocity = plane_(state.velocity);
    Vector3<Scalar> position = from + velocity * dt;
    if (p.integrator == Integrator::kParabolic) position += a * (Scalar(0.5) * dt * dt);
    velocity += a * dt;

    const Spheroid<Scalar> before(begin.left, begin.right, string.length),
        after(end.left, end.right, string.length);
    const bool published = p.flight_rule == FlightRule::kPublished;
    state.string_state = published ? published_string_state(state.string_state, position, after, p)
                                   : paper_string_state(state.string_state, position, after, p);
    const Mask<Scalar> held =
        is(state.string_state, StringState::kOnString) && !after.contains(position) && !after.overstretched();
    Vector3<Scalar> pulled = Vector3<Scalar>::Constant(Scalar(0));
    if (any(held)) {
      const Vector3<Scalar> target =
          plane_.on(from, p.projection == Projection::kRadial ? after.radial_point(position)
                                                              : after.closest_point(position));
      const Vector3<Scalar> gradient = after.path_gradient(target);
      const Scalar give =
          string.compliance /
          (string.compliance + Scalar(0.5) * dt * dt * squared_norm(gradient) + tiny<Scalar>());
      const Vector3<Scalar> put = target + (position - target) * give;
      const Vector3<Scalar> normal = normal_at(after, put);
      const Vector3<Scalar> facing = normal_at(after, position);
      const Vector3<Scalar> cap = facing * Scalar(-p.cap_scale * pull_cap(before, after, facing, dt));
      Vector3<Scalar> pull = capped_pull<Scalar>(put - position, normal, cap, dt, p.pull_scale);
      const Mask<Scalar> thin = after.tip_distance() >= string.length - p.thin_slack;
      pull = select<Scalar>(thin,
                            p.thin_rule == ThinRule::kPublished
                                ? pull_in_vertical_plane<Scalar>(pull, end.left, end.right)
                                : pull_across_plane<Scalar>(pull, end.left, end.right),
                            pull);
      const Scalar share = p.pull_scale_after_cap * factor_time(dt) / p.reference_step;
      pulled = select<Scalar>(held, plane_(pull) * share, pulled);
      Vector3<Scalar> moved = velocity * dissipation(dt, held) + pulled;
      const Vector3<Scalar> outward = plane_(normal);
      const Scalar outward_rate = maximum(dot<Scalar>(moved, outward), Scalar(0));
      moved = moved - outward * Scalar(outward_rate / (squared_norm(outward) + tiny<Scalar>()));
      position = select<Scalar>(held, put, position);
      velocity = select<Scalar>(held, moved, velocity);
    }
    if (!published)
      velocity = velocity * dissipation(dt, !held && is(state.string_state, StringState::kOnString));
    const Scalar change = norm<Scalar>(position - end.right) - norm<Scalar>(from - begin.right);
    if (p.spin_rule == SpinRule::kLengthChange) {
      const Mask<Scalar> stays = was_on_string && is(state.string_state, StringState::kOnString);
      state.spin = select(stays, spin_after_length_change(state.spin, change, p), state.spin);
    } else {
      const Scalar slipped =
          p.per_step ? spin_after_slip_explicit<Scalar>(state.spin, change / dt, factor_time(dt), p)
                     : spin_after_slip<Scalar>(state.spin, change / dt, factor_time(dt), p);
      state.spin = select(held && was_on_string, slipped, state.spin);
    }
    state.spin = effects_.after_torques(state.spin, state, dt, parameters_);
    StringStepResult<Scalar> result;
    result.position = position;
    result.velocity = velocity;
    result.string_acceleration = pulled * Scalar(Scalar(1) / dt);
    result.taut = held;
    effects_.touch(velocity, state.spin, state, end, result, dt, p);
    state.velocity = plane_(velocity);
    state.position = position;
    state.string_acceleration = result.string_acceleration;
    status.overstretched = after.overstretched();
    if (!p.release_when_overstretched && any(status.overstretched))
      hold(state, end, dt, !is(state.string_state, StringState::kFlying) && status.overstretched, string);
    return status;
  }

  static bool elastic(const StringNow<Scalar>& string) {
    return kMayStretch && !is_constant_zero(string.compliance);
  }
  /// On a straight string; an elastic one is longer.
  void hold(State<Scalar>& state, const Tips<Scalar>& tips, const Scalar& dt, const Mask<Scalar>& where,
            const StringNow<Scalar>& string) const {
    hold_between_tips<Scalar>(state, tips, dt, where && (string.compliance == Scalar(0)), plane_);
  }

  Scalar dissipation(const Scalar& dt, const Mask<Scalar>& where) const {
    using std::exp;
    if (is_constant_zero(parameters_.dissipation_rate)) return Scalar(1);
    return select(where, Scalar(exp(-parameters_.dissipation_rate * factor_time(dt))), Scalar(1));
  }

  Vector3<Scalar> normal_at(const Spheroid<Scalar>& s, const Vector3<Scalar>& point) const {
    return parameters_.normal_rule == NormalRule::kPublished ? s.published_normal(point) : s.normal(point);
  }

  Parameters<Scalar> parameters_;
  Set effects_;
  StringNow<Scalar> string_;
  PlaneProjector<Scalar> plane_;
};

}  // namespace diabolo
