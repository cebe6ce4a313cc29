// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/parameters.hpp"
#include "diabolo/state.hpp"
#include "diabolo/string/spheroid.hpp"
#include "diabolo/string/tip_geometry.hpp"

namespace diabolo {

/// The taut catch: tips nearly a string length apart under the diabolo, which is between them and close to
/// their line.
template <class Scalar>
Mask<Scalar> taut_catch(const Vector3<Scalar>& point, const Spheroid<Scalar>& spheroid,
                        const Parameters<Scalar>& parameters) {
  return (spheroid.tip_distance() >= spheroid.string_length() - parameters.catch_slack) &&
         between_tips(point, spheroid.left(), spheroid.right()) &&
         (distance_to_tip_line(point, spheroid.left(), spheroid.right()) < parameters.catch_distance);
}

/// Ours, for the inextensible string: as the paper's, with the distance inside the spheroid taken to first
/// order from the slack, s = (L - path length) / |gradient| (no root search; exact for a string that is
/// nearly taut), and leaving only between the tips, where the slack string falls off the axle, unless it is
/// `wound` around it.
template <class Scalar>
StringStateOf<Scalar> slack_string_state(StringStateOf<Scalar> state, const Vector3<Scalar>& point,
                                         const Scalar& slack, const Scalar& gradient_squared,
                                         const Vector3<Scalar>& left, const Vector3<Scalar>& right,
                                         const Mask<Scalar>& wound, const Parameters<Scalar>& parameters) {
  const Scalar gradient = positive_sqrt<Scalar>(gradient_squared);
  const Mask<Scalar> flying = is(state, StringState::kFlying);
  const Mask<Scalar> leaves = !flying && (slack > parameters.flying_distance * gradient) && !wound &&
                              (height_above_tips(point, left, right) > Scalar(0)) &&
                              between_tips(point, left, right);
  const Mask<Scalar> loosens =
      is(state, StringState::kOnString) && (slack > parameters.loose_distance * gradient);
  assign_where(loosens, state, StringState::kLoose);
  assign_where(leaves, state, StringState::kFlying);
  return state;
}

}  // namespace diabolo
