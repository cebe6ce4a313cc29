// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "diabolo/math/pairs.hpp"
#include "diabolo/sticks.hpp"

namespace diabolo {

/// The taut string from the left tip over the diabolo to the right tip, at an instant.
template <class Scalar>
struct StringPath {
  Vector3<Scalar> from_left, from_right;  ///< diabolo minus tip [m]
  Scalar left_length, right_length;       ///< of the two strands [m]

  [[gnu::always_inline]] inline StringPath(const Vector3<Scalar>& diabolo, const Tips<Scalar>& tips)
      : from_left(diabolo - tips.left), from_right(diabolo - tips.right) {
    const std::array<Scalar, 2> lengths = norms<Scalar>(from_left, from_right);
    left_length = lengths[0];
    right_length = lengths[1];
  }

  /// Takes the lanes `where` from another path.
  void keep_where(const Mask<Scalar>& where, const StringPath& other) {
    from_left = select<Scalar>(where, other.from_left, from_left);
    from_right = select<Scalar>(where, other.from_right, from_right);
    left_length = select(where, other.left_length, left_length);
    right_length = select(where, other.right_length, right_length);
  }

  Scalar length() const { return left_length + right_length; }

  /// Right strand minus left strand [m]; half its change is the string that has passed the axle.
  Scalar imbalance() const { return right_length - left_length; }

  /// Angle over which the string lies around a thin axle: pi where both strands hang together, 0 where they
  /// are one straight line.
  friend Scalar contact_angle(const StringPath& path) {
    using std::atan2;
    const auto [left, right] = path.directions();
    return Scalar(2) * atan2(norm<Scalar>(left + right), Scalar(norm<Scalar>(left - right) + tiny<Scalar>()));
  }

  /// Unit vectors from the left and the right tip to the diabolo.
  [[gnu::always_inline]] inline std::array<Vector3<Scalar>, 2> directions() const {
    const std::array<Scalar, 2> inverse = inverses(left_length, right_length);
    return {from_left * inverse[0], from_right * inverse[1]};
  }

  /// Derivative of the length with respect to the diabolo's position.
  [[gnu::always_inline]] inline Vector3<Scalar> gradient() const {
    const std::array<Scalar, 2> inverse = inverses(left_length, right_length);
    return from_left * inverse[0] + from_right * inverse[1];
  }

  /// Rate of the length [m/s] by the tips' velocities alone.
  [[gnu::always_inline]] inline Scalar tip_rate(const Vector3<Scalar>& left_velocity,
                                                const Vector3<Scalar>& right_velocity) const {
    const std::array<Scalar, 2> rates =
        quotients(Scalar(-dot(from_left, left_velocity)), Scalar(dot(from_right, right_velocity)),
                  left_length, right_length);
    return rates[0] - rates[1];
  }

  /// Rate of the length [m/s].
  Scalar rate(const Vector3<Scalar>& velocity, const Vector3<Scalar>& left_velocity,
              const Vector3<Scalar>& right_velocity) const {
    return dot(gradient(), velocity) + tip_rate(left_velocity, right_velocity);
  }
};

/// Discrete gradient of the length between two instants (Gonzalez 1996): its product with the diabolo's
/// displacement relative to the tips is exactly the change of the length. A force along it does exactly the
/// work that a string of constant length does, so that a step along it keeps the energy whatever its size.
template <class Scalar>
[[gnu::always_inline]] inline Vector3<Scalar> discrete_gradient(const StringPath<Scalar>& a,
                                                                const StringPath<Scalar>& b) {
  const std::array<Scalar, 2> inverse =
      inverses(Scalar(a.left_length + b.left_length), Scalar(a.right_length + b.right_length));
  return (a.from_left + b.from_left) * inverse[0] + (a.from_right + b.from_right) * inverse[1];
}

}  // namespace diabolo
