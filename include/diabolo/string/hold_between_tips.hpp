// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/state.hpp"
#include "diabolo/sticks.hpp"
#include "diabolo/string/string_step.hpp"

namespace diabolo {

/// The tips are as far apart as the string is long, or farther: there is no spheroid, and in the lanes
/// `where` the diabolo rests on the straight string and moves with it.
template <class Scalar>
[[gnu::noinline]] void hold_between_tips(State<Scalar>& state, const Tips<Scalar>& tips, const Scalar& dt,
                                         const Mask<Scalar>& where, const PlaneProjector<Scalar>& plane) {
  const Vector3<Scalar> span = tips.left - tips.right;
  const Scalar along = dot<Scalar>(state.position - tips.right, span) / (squared_norm(span) + tiny<Scalar>());
  const Scalar fraction = minimum(maximum(along, Scalar(0)), Scalar(1));
  const Vector3<Scalar> velocity =
      plane(tips.right_velocity + (tips.left_velocity - tips.right_velocity) * fraction);
  const Vector3<Scalar> position = plane.on(state.position, tips.right + span * fraction);
  const Vector3<Scalar> jerked =
      state.string_acceleration + (velocity - state.velocity) * Scalar(Scalar(1) / dt);
  state.position = select<Scalar>(where, position, state.position);
  state.velocity = select<Scalar>(where, velocity, state.velocity);
  state.string_acceleration = select<Scalar>(where, jerked, state.string_acceleration);
  assign_where(where, state.string_state, StringState::kOnString);
}

}  // namespace diabolo
