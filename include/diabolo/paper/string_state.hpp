// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/string/catch_and_release.hpp"

namespace diabolo {

/// The authors' program. `point` is the extrapolated position; a diabolo that is not flying and outside the
/// spheroid is ON_STRING.
template <class Scalar>
StringStateOf<Scalar> published_string_state(StringStateOf<Scalar> state, const Vector3<Scalar>& point,
                                             const Spheroid<Scalar>& spheroid,
                                             const Parameters<Scalar>& parameters) {
  const Vector3<Scalar>&left = spheroid.left(), &right = spheroid.right();
  const Mask<Scalar> over = (height_above_tips(point, left, right) > Scalar(0)) &&
                            between_tips(point, left, right) &&
                            ((point.z() > left.z()) || (point.z() > right.z()));
  const Mask<Scalar> was_flying = is(state, StringState::kFlying);
  const Mask<Scalar> caught = was_flying && !over && taut_catch(point, spheroid, parameters);
  const Mask<Scalar> inside = spheroid.contains(point) || spheroid.overstretched();
  const Mask<Scalar> captured = !was_flying && !over;
  assign_where(captured && inside, state, StringState::kLoose);
  assign_where(captured && !inside, state, StringState::kOnString);
  assign_where(caught, state, StringState::kLoose);
  assign_where(over, state, StringState::kFlying);
  return state;
}

/// The paper's figure of the states; its labels are lost in the source, so that this is our reading of the
/// text: with s > 0 inside, ON_STRING -> LOOSE when s > c_L; LOOSE -> ON_STRING when s <= 0; either -> FLYING
/// when s > c_F above the plane of the tips; FLYING -> LOOSE by the taut catch only, at or below that plane,
/// so that a throw is not caught as it leaves.
template <class Scalar>
StringStateOf<Scalar> paper_string_state(StringStateOf<Scalar> state, const Vector3<Scalar>& point,
                                         const Spheroid<Scalar>& spheroid,
                                         const Parameters<Scalar>& parameters) {
  const Scalar s = spheroid.signed_distance(point);
  const Mask<Scalar> above = height_above_tips(point, spheroid.left(), spheroid.right()) > Scalar(0);
  const Mask<Scalar> flying = is(state, StringState::kFlying);
  const Mask<Scalar> leaves = !flying && above && (s > parameters.flying_distance);
  const Mask<Scalar> caught = flying && !above && taut_catch(point, spheroid, parameters);
  const Mask<Scalar> loosens = is(state, StringState::kOnString) && (s > parameters.loose_distance);
  const Mask<Scalar> tautens = is(state, StringState::kLoose) && (s <= Scalar(0));
  assign_where(loosens, state, StringState::kLoose);
  assign_where(tautens, state, StringState::kOnString);
  assign_where(caught, state, StringState::kLoose);
  assign_where(leaves, state, StringState::kFlying);
  return state;
}

}  // namespace diabolo
