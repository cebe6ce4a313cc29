// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/effects/effect.hpp"
#include "diabolo/string/winding.hpp"

namespace diabolo {

namespace effect_detail {

/// A step of a string around an axle as its friction sees it: impulses are half differences of the strands'
/// tensions over the diabolo's mass, times the step [m/s], positive towards the right tip.
template <class Scalar>
struct WoundStep {
  const State<Scalar>& state;
  const Tips<Scalar>& tips;  ///< at the end
  const StringStepResult<Scalar>& result;
  const Scalar& dt;
  Tips<Scalar> first;  ///< tips at the beginning
  StringPath<Scalar> begin, last;
  /// Mean unit vectors along the strands; their products with the diabolo's way are just what passes the
  /// axle.
  Vector3<Scalar> left, right;
  Vector3<Scalar> across;  ///< right less left: change of the velocity by an impulse of one

  WoundStep(const State<Scalar>& before, const Tips<Scalar>& end, const StringStepResult<Scalar>& outcome,
            const Scalar& duration)
      : state(before),
        tips(end),
        result(outcome),
        dt(duration),
        first(moved_back(end, duration)),
        begin(before.position, first),
        last(outcome.position, end),
        left((begin.from_left + last.from_left) *
             Scalar(Scalar(-1) / (begin.left_length + last.left_length))),
        right((begin.from_right + last.from_right) *
              Scalar(Scalar(-1) / (begin.right_length + last.right_length))),
        across(right - left) {}

  static Tips<Scalar> moved_back(Tips<Scalar> tips, const Scalar& time) {
    tips.left -= tips.left_velocity * time;
    tips.right -= tips.right_velocity * time;
    return tips;
  }
  StringPath<Scalar> middle() const {
    return {Vector3<Scalar>((state.position + result.position) * Scalar(0.5)),
            moved_back(tips, Scalar(0.5) * dt)};
  }

  /// String that passes the axle at the end [m/s].
  Scalar passing() const {
    return Scalar(0.5) *
           (dot<Scalar>(last.from_right, result.velocity - tips.right_velocity) / last.right_length -
            dot<Scalar>(last.from_left, result.velocity - tips.left_velocity) / last.left_length);
  }

  /// What an impulse of one adds to the tension times the step, by the velocity at which it bends the path.
  Scalar bending() const {
    const auto turn = [&](const Vector3<Scalar>& e, const Vector3<Scalar>& velocity, const Scalar& length) {
      return (dot<Scalar>(across, velocity) - dot<Scalar>(e, across) * dot<Scalar>(e, velocity)) / length;
    };
    const Vector3<Scalar> velocity = (state.velocity + result.velocity) * Scalar(0.5);
    return Scalar(0.5) * dt *
           (turn(left, velocity - tips.left_velocity, last.left_length) +
            turn(right, velocity - tips.right_velocity, last.right_length)) /
           maximum(squared_norm<Scalar>(left + right), Scalar(4e-4));
  }
};

/// Energy over mass that an impulse j brings, j (quadratic j - 2 slip) [m^2/s^2], to the diabolo, its spin
/// and its height: a step of the velocity by `push` j and of the position by half of that, along the string.
template <class Scalar>
struct ImpulseEnergy {
  Vector3<Scalar> push;
  Scalar slip, quadratic;

  /// `surface` is the speed of the axle under the string [m/s], `spin_mobility` what an impulse of one adds
  /// to it.
  ImpulseEnergy(const WoundStep<Scalar>& s, const Scalar& surface, const Scalar& spin_mobility) {
    // Along the taut string at the end of the step: what points off it would come back as tension.
    const Vector3<Scalar> normal = s.last.gradient();
    const Scalar square = maximum(squared_norm(normal), Scalar(4e-4));
    const Scalar off = dot<Scalar>(normal, s.across) / square;
    push = s.across - normal * off;
    // By what is not of the string the velocity changes over the step; half of it is to come in the middle.
    const Vector3<Scalar> outer = s.result.velocity - s.state.velocity - s.result.string_acceleration * s.dt;
    const Vector3<Scalar> travel = (s.result.position - s.state.position) * Scalar(Scalar(1) / s.dt) -
                                   s.result.velocity + outer * Scalar(0.5);
    const Scalar outward = dot<Scalar>(normal, outer);
    slip = s.result.passed / s.dt - surface + Scalar(0.5) * dot<Scalar>(s.across, travel) -
           Scalar(0.25) * off * outward;
    // The path curves inwards, against gravity.
    const auto curve = [&](const Vector3<Scalar>& e, const Scalar& length) {
      const Scalar on = dot<Scalar>(e, push);
      return (squared_norm(push) - on * on) / length;
    };
    const Scalar rise = Scalar(0.125) * s.dt * (maximum(outward, Scalar(0)) / square) *
                        (curve(s.left, s.last.left_length) + curve(s.right, s.last.right_length));
    quadratic = Scalar(0.5) * squared_norm(s.across) + spin_mobility + rise + tiny<Scalar>();
  }
};

}  // namespace effect_detail

/// Friction of a string whose turns around the axle come and go (Parameters::follow_turns): the capstan law
/// of StringFriction over the whole wound angle b, with stick. Half the difference of the tensions over their
/// mean is no more than tanh(coefficient b / 2); below that it is what takes the slip to zero at the end of
/// the step, of the diabolo and of its spin together. It never brings energy to what the tips leave alone.
/// `tips` are those of the step's end.
template <class Scalar>
Contact<Scalar> wound_contact(const Scalar& coefficient, const Scalar& spin_gain, const State<Scalar>& state,
                              const Tips<Scalar>& tips, const StringStepResult<Scalar>& result,
                              const Scalar& dt, const Parameters<Scalar>& parameters) {
  using std::tanh;
  const effect_detail::WoundStep<Scalar> step(state, tips, result, dt);
  const Winding<Scalar> wound = winding(state, step.middle(), parameters);
  const Scalar surface = wound.side * parameters.axle_radius * state.spin;
  const Scalar spin_mobility = Scalar(2) * parameters.axle_radius * spin_gain;
  const effect_detail::ImpulseEnergy<Scalar> energy(step, surface, spin_mobility);

  const Scalar mobility = Scalar(0.5) * squared_norm(step.across) + spin_mobility + tiny<Scalar>();
  const Scalar stopping = (step.passing() - surface) / mobility;
  const Scalar lossless = Scalar(2) * energy.slip / energy.quadratic;
  const Scalar sticking =
      maximum(minimum(stopping, maximum(lossless, Scalar(0))), minimum(lossless, Scalar(0)));
  const Scalar limit = tanh(Scalar(0.5) * coefficient * wound.angle);
  const auto within = [&](const Scalar& tension) {
    const Scalar most = maximum(tension, Scalar(0)) * limit;
    return maximum(minimum(sticking, most), Scalar(-most));
  };
  const Scalar tension = result.tension * dt;
  // The tension was found without friction, which bends the path by what it does to the velocity.
  const Scalar impulse = select(result.taut, within(tension + step.bending() * within(tension)), Scalar(0));
  const Scalar difference = Scalar(2) * impulse;
  return {energy.push * impulse, wound.side * spin_gain * difference, difference / dt};
}

}  // namespace diabolo
