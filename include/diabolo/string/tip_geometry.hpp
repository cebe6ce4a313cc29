// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/math/scalar.hpp"

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

}  // namespace diabolo
