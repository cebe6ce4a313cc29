// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

#include "diabolo/string/winding.hpp"

namespace diabolo {

/// Reads the turns of the string around the axle from its strands; a flying diabolo has none.
template <class Scalar>
void count_turns(State<Scalar>& state, const Tips<Scalar>& tips, const Parameters<Scalar>& parameters) {
  const StringPath<Scalar> path(state.position, tips);
  const Scalar turns = wound_angle(state, path, parameters) * Scalar(0.5 * std::numbers::inv_pi);
  state.turns = select(is(state.string_state, StringState::kFlying), Scalar(0), turns) - parameters.wraps;
}

namespace string_detail {

/// A point that moves from `a` to `b` with the given velocities there, at the fraction `u` of `dt`: a cubic.
template <class Scalar>
Vector3<Scalar> cubic_between(const Vector3<Scalar>& a, const Vector3<Scalar>& a_velocity,
                              const Vector3<Scalar>& b, const Vector3<Scalar>& b_velocity, const Scalar& dt,
                              const Scalar& u) {
  const Scalar w = Scalar(1) - u;
  return a * Scalar(w * w * (Scalar(1) + Scalar(2) * u)) + b * Scalar(u * u * (Scalar(1) + Scalar(2) * w)) +
         (a_velocity * w - b_velocity * u) * Scalar(u * w * dt);
}

/// Sine and cosine of turn_at_axle() at the fraction `u` of a step.
template <class Scalar>
std::array<Scalar, 2> turn_within(const State<Scalar>& before, const State<Scalar>& after,
                                  const Tips<Scalar>& begin, const Tips<Scalar>& end, const Scalar& dt,
                                  const Scalar& u) {
  const Tips<Scalar> tips{
      cubic_between<Scalar>(begin.left, begin.left_velocity, end.left, end.left_velocity, dt, u),
      cubic_between<Scalar>(begin.right, begin.right_velocity, end.right, end.right_velocity, dt, u)};
  const Vector3<Scalar> position =
      cubic_between<Scalar>(before.position, before.velocity, after.position, after.velocity, dt, u);
  return turn_at_axle(StringPath<Scalar>(position, tips),
                      Vector3<Scalar>(before.axis + (after.axis - before.axis) * u));
}

}  // namespace string_detail

/// Says in `status` whether a turn came onto the axle or went off it within a step, and when: both strands
/// then point apart, seen along the axle. Found by bisection along cubics through the ends of the step, to a
/// billionth of it; carries no derivatives.
template <class Scalar>
void locate_turn(const State<Scalar>& before, const State<Scalar>& after, const Tips<Scalar>& begin,
                 const Tips<Scalar>& end, const Scalar& dt, const Parameters<Scalar>& parameters,
                 StepStatus<Scalar>& status) {
  const Scalar had = absolute<Scalar>(parameters.wraps + before.turns),
               has = absolute<Scalar>(parameters.wraps + after.turns);
  const auto at = [&](const Scalar& u) {
    return string_detail::turn_within(before, after, begin, end, dt, u);
  };
  const auto first = at(Scalar(0)), last = at(Scalar(1));
  const Mask<Scalar> ahead = first[0] < Scalar(0);
  const auto is_past = [&](const Scalar& sine) {
    const Mask<Scalar> negative = sine < Scalar(0);
    return (ahead && !negative) || (!ahead && negative);
  };
  const Mask<Scalar> turned = is_past(last[0]) && (last[1] > Scalar(0)) && (has > Scalar(0.5));
  if (!any(turned)) return;
  Scalar low{0}, high{1};
  for (int i = 0; i < 30; ++i) {
    const Scalar middle = Scalar(0.5) * (low + high);
    const Mask<Scalar> passed = is_past(at(middle)[0]);
    low = select(passed, low, middle);
    high = select(passed, middle, high);
  }
  status.turned = select(turned, select(has > had, Scalar(1), Scalar(-1)), Scalar(0));
  status.turned_at = select(turned, Scalar(high * dt), Scalar(0));
}

}  // namespace diabolo
