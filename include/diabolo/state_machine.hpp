// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/parameters.hpp"
#include "diabolo/spheroid.hpp"
#include "diabolo/state.hpp"

namespace diabolo {

/// Height of a point above the plane through both tips that contains the world's x axis [m], times the
/// horizontal distance of the tips: only its sign is used. Zero for tips one above the other's x line.
template <class Scalar>
Scalar height_above_tips(const Vector3<Scalar>& point, const Vector3<Scalar>& left,
                         const Vector3<Scalar>& right) {
  const Vector3<Scalar> span = left - right;
  const Vector3<Scalar> offset = point - right;
  // offset . (x_world cross span), turned so that it points upwards
  const Scalar height = offset.z() * span.y() - offset.y() * span.z();
  return select(span.y() < Scalar(0), Scalar(-height), height);
}

/// Whether the point lies in the ball that has the tips on its surface: (l - p) . (r - p) <= 0.
template <class Scalar>
Mask<Scalar> between_tips(const Vector3<Scalar>& point, const Vector3<Scalar>& left,
                          const Vector3<Scalar>& right) {
  return dot<Scalar>(left - point, right - point) <= Scalar(0);
}

/// Distance of a point from the line through the tips [m].
template <class Scalar>
Scalar distance_to_tip_line(const Vector3<Scalar>& point, const Vector3<Scalar>& left,
                            const Vector3<Scalar>& right) {
  const Vector3<Scalar> span = left - right;
  const Vector3<Scalar> offset = point - right;
  const Scalar along = dot<Scalar>(offset, span) / (squared_norm(span) + tiny<Scalar>());
  return norm<Scalar>(offset - span * along);
}

/// The taut catch: tips nearly a string length apart under the diabolo, which is between them and close to
/// their line.
template <class Scalar>
Mask<Scalar> taut_catch(const Vector3<Scalar>& point, const Spheroid<Scalar>& spheroid,
                        const Parameters<Scalar>& parameters) {
  return (spheroid.tip_distance() >= spheroid.string_length() - parameters.catch_slack) &&
         between_tips(point, spheroid.left(), spheroid.right()) &&
         (distance_to_tip_line(point, spheroid.left(), spheroid.right()) < parameters.catch_distance);
}

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

/// Ours, for the inextensible string: as the paper's, with the distance inside the spheroid taken to first
/// order from the slack, s = (L - path length) / |gradient| (no root search; exact for a string that is
/// nearly taut), and leaving only between the tips, where the slack string falls off the axle. One that is
/// wrapped around the axle does not.
template <class Scalar>
StringStateOf<Scalar> slack_string_state(StringStateOf<Scalar> state, const Vector3<Scalar>& point,
                                         const Scalar& slack, const Scalar& gradient_squared,
                                         const Vector3<Scalar>& left, const Vector3<Scalar>& right,
                                         const Parameters<Scalar>& parameters) {
  const Scalar gradient = positive_sqrt<Scalar>(gradient_squared);
  const Mask<Scalar> flying = is(state, StringState::kFlying);
  const Mask<Scalar> leaves =
      !flying && (slack > parameters.flying_distance * gradient) && (parameters.wraps < Scalar(0.5)) &&
      (height_above_tips(point, left, right) > Scalar(0)) && between_tips(point, left, right);
  const Mask<Scalar> loosens =
      is(state, StringState::kOnString) && (slack > parameters.loose_distance * gradient);
  assign_where(loosens, state, StringState::kLoose);
  assign_where(leaves, state, StringState::kFlying);
  return state;
}

}  // namespace diabolo
