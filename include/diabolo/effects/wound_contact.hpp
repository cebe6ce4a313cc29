// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/effects/effect.hpp"
#include "diabolo/string/winding.hpp"

namespace diabolo {

/// Friction of a string whose turns around the axle come and go (Parameters::follow_turns): the capstan law of
/// StringFriction over the whole wound angle b, with stick. Half the difference of the tensions over their
/// mean T is no more than tanh(coefficient b / 2); below that it is what takes the slip to zero at the end of
/// the step, of the diabolo and of its spin together. It never turns the slip of the step's middle round, so
/// that friction takes energy whatever the step. `tips` are those of the step's end.
template <class Scalar>
Contact<Scalar> wound_contact(const Scalar& coefficient, const Scalar& spin_gain, const State<Scalar>& state,
                              const Tips<Scalar>& tips, const StringStepResult<Scalar>& result,
                              const Scalar& dt, const Parameters<Scalar>& parameters) {
  using std::tanh;
  const Scalar half = Scalar(0.5) * dt;
  Tips<Scalar> there = tips;
  there.left -= tips.left_velocity * half;
  there.right -= tips.right_velocity * half;
  const StringPath<Scalar> path(Vector3<Scalar>((state.position + result.position) * Scalar(0.5)), there);
  const Winding<Scalar> wound = winding(state, path, parameters);
  const Vector3<Scalar> left = path.from_left * Scalar(Scalar(-1) / path.left_length),
                        right = path.from_right * Scalar(Scalar(-1) / path.right_length);
  const Vector3<Scalar> across = right - left, along = right + left;

  // Slip without friction, its mean and at the end of the step, and what a difference of the tensions takes.
  const StringPath<Scalar> last(result.position, tips);
  const Scalar passing =
      Scalar(0.5) *
      (dot<Scalar>(last.from_right, result.velocity - tips.right_velocity) / last.right_length -
       dot<Scalar>(last.from_left, result.velocity - tips.left_velocity) / last.left_length);
  const Scalar surface = wound.side * parameters.axle_radius * state.spin;
  const Scalar mean_slip = result.passed / dt - surface, end_slip = passing - surface;
  const Scalar mobility =
      Scalar(0.5) * squared_norm(across) + Scalar(2) * parameters.axle_radius * spin_gain + tiny<Scalar>();
  const Scalar stopping = end_slip / mobility, turning = Scalar(2) * mean_slip / mobility;
  const Scalar sticking = maximum(minimum(stopping, maximum(turning, Scalar(0))), minimum(turning, Scalar(0)));

  // The tension was found without friction, which bends the path by what it does to the velocity.
  const Scalar limit = tanh(Scalar(0.5) * coefficient * wound.angle);
  const auto clamped = [&](const Scalar& most) { return maximum(minimum(sticking, most), Scalar(-most)); };
  const Scalar tension = result.tension * dt;
  const Scalar first = clamped(tension * limit);
  const auto turn = [&](const Vector3<Scalar>& e, const Vector3<Scalar>& velocity) {
    return dot<Scalar>(across, velocity) - dot<Scalar>(e, across) * dot<Scalar>(e, velocity);
  };
  const Vector3<Scalar> velocity = (state.velocity + result.velocity) * Scalar(0.5);
  const Scalar bend = turn(left, velocity - tips.left_velocity) / path.left_length +
                      turn(right, velocity - tips.right_velocity) / path.right_length;
  const Scalar square = maximum(squared_norm(along), Scalar(4e-4));
  const Scalar feedback = half * first * bend / square;
  const Scalar most = maximum(Scalar(tension + feedback), Scalar(0)) * limit;
  const Scalar impulse = select(result.taut, clamped(most), Scalar(0));

  // Along the taut string at the end of the step: what points off it would come back as tension.
  const Vector3<Scalar> normal = last.gradient();
  const Scalar off = dot(normal, across) / maximum(squared_norm(normal), Scalar(4e-4));
  const Scalar difference = Scalar(2) * impulse;
  return {(across - normal * off) * impulse, wound.side * spin_gain * difference, difference / dt};
}

}  // namespace diabolo
