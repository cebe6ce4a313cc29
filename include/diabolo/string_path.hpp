// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/sticks.hpp"

namespace diabolo {

/// The taut string from the left tip over the diabolo to the right tip, at an instant.
template <class Scalar>
struct StringPath {
  Vector3<Scalar> from_left, from_right;  ///< diabolo minus tip [m]
  Scalar left_length, right_length;       ///< of the two strands [m]

  StringPath(const Vector3<Scalar>& diabolo, const Vector3<Scalar>& left, const Vector3<Scalar>& right)
      : from_left(diabolo - left),
        from_right(diabolo - right),
        left_length(norm<Scalar>(from_left)),
        right_length(norm<Scalar>(from_right)) {}

  Scalar length() const { return left_length + right_length; }

  /// Derivative of the length with respect to the diabolo's position.
  Vector3<Scalar> gradient() const { return from_left / left_length + from_right / right_length; }

  /// Rate of the length [m/s] for the given velocities.
  Scalar rate(const Vector3<Scalar>& velocity, const Vector3<Scalar>& left_velocity,
              const Vector3<Scalar>& right_velocity) const {
    return Scalar(from_left.dot(velocity - left_velocity)) / left_length +
           Scalar(from_right.dot(velocity - right_velocity)) / right_length;
  }
};

/// Discrete gradient of the length between two instants (Gonzalez 1996): its product with the diabolo's displacement
/// relative to the tips is exactly the change of the length. A force along it does exactly the work that a string of
/// constant length does, so that a step along it keeps the energy whatever its size.
template <class Scalar>
Vector3<Scalar> discrete_gradient(const StringPath<Scalar>& a, const StringPath<Scalar>& b) {
  return (a.from_left + b.from_left) / (a.left_length + b.left_length) +
         (a.from_right + b.from_right) / (a.right_length + b.right_length);
}

}  // namespace diabolo
