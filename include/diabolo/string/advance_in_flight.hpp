// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/string/catch_and_release.hpp"
#include "diabolo/string/spheroid.hpp"
#include "diabolo/string/taut_string.hpp"
#include "diabolo/string/tip_geometry.hpp"

namespace diabolo {

/// A step of the lanes that the string holds; the others fly freely, and so do those where an inextensible
/// string does not reach from tip to tip. `kMayStretch` false leaves the spring out.
template <bool kMayStretch, class Scalar>
StringStepResult<Scalar> advance_captured(const StringStep<Scalar>& step, const Mask<Scalar>& captured) {
  if constexpr (kMayStretch)
    if (!is_constant_zero(step.compliance)) return advance_on_string<true>(step, captured);
  return advance_on_string<false>(step, captured && !step.overstretched());
}

/// A step in which some lane is in flight. A diabolo that falls through the plane of the tips is caught
/// there if the string is tight under it; the rest of the step is on the loose string.
template <bool kMayStretch, class Scalar>
[[gnu::noinline]] StringStepResult<Scalar> advance_in_flight(State<Scalar>& state,
                                                             const StringStep<Scalar>& step,
                                                             const Parameters<Scalar>& parameters,
                                                             Mask<Scalar>& caught) {
  const Mask<Scalar> flying = is(state.string_state, StringState::kFlying);
  const auto height = [&](const Scalar& fraction) {
    const Tips<Scalar> tips = step.tips_at(fraction);
    return height_above_tips<Scalar>(step.free_position(fraction * step.dt), tips.left, tips.right);
  };
  Scalar low{0}, high{1};
  Scalar high_height = height(Scalar(1)), low_height = height(Scalar(0));
  const Mask<Scalar> falls = flying && (low_height > Scalar(0)) && (high_height <= Scalar(0));
  if (!any(falls)) return advance_captured<kMayStretch>(step, !flying);
  for (int i = 0; i < 4; ++i) {  // secant steps on a function that is all but linear
    const Scalar middle = low + (high - low) * low_height / (low_height - high_height + tiny<Scalar>());
    const Scalar middle_height = height(middle);
    const Mask<Scalar> above = middle_height > Scalar(0);
    low = select(above, middle, low);
    low_height = select(above, middle_height, low_height);
    high = select(above, high, middle);
    high_height = select(above, high_height, middle_height);
  }
  const Tips<Scalar> there = step.tips_at(high);
  const Vector3<Scalar> crossing = step.free_position(high * step.dt);
  const Spheroid<Scalar> spheroid(there.left, there.right, step.string_length);
  caught = falls && taut_catch(crossing, spheroid, parameters) && spheroid.contains(crossing);
  const Scalar fraction = select(caught, minimum(high, Scalar(1.0 - 1e-6)), Scalar(0));
  const Scalar t = fraction * step.dt;
  const Tips<Scalar> tips = step.tips_at(fraction);
  const Vector3<Scalar> position = step.free_position(t), velocity = step.free_velocity(t);
  const StringStep<Scalar> rest = step.rest(position, velocity, tips, step.dt - t);
  assign_where(caught, state.string_state, StringState::kLoose);
  StringStepResult<Scalar> result =
      advance_captured<kMayStretch>(rest, !is(state.string_state, StringState::kFlying));
  const Scalar share = rest.dt / step.dt;  // of the step, over which both are means
  result.string_acceleration = result.string_acceleration * share;
  result.tension = result.tension * share;
  return result;
}

}  // namespace diabolo
