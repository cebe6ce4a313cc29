// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/state.hpp"
#include "diabolo/string/string_step.hpp"

namespace diabolo {

/// The strands of a string that was taut have turned a little since the last step: their length is as it was
/// up to second order. The rest is put right, lest the string count as slack.
template <class Scalar>
void settle_on_string(State<Scalar>& state, const Tips<Scalar>& tips, const Scalar& length,
                      const PlaneProjector<Scalar>& plane) {
  const StringPath<Scalar> path(state.position, tips);
  const Scalar gap = path.length() - length;
  const Vector3<Scalar> gradient = plane(path.gradient());
  const Scalar square = squared_norm(gradient);
  // Near a straight string the path grows with the square of the distance from it: a gap that is large
  // against the gradient is no matter of first order.
  const Mask<Scalar> taut = (squared_norm(state.string_acceleration) > Scalar(0)) &&
                            (absolute<Scalar>(gap) < Scalar(1e-4) * square * length);
  const Scalar move = select(taut, Scalar(gap / (square + tiny<Scalar>())), Scalar(0));
  state.position = state.position - plane(gradient * move);
}

}  // namespace diabolo
