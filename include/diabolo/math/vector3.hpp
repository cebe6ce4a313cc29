// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace diabolo {

/// A column of three components; positions in [m], world frame x forward (away from the player), y left, z
/// up.
template <class Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;

/// Standard acceleration of gravity [m/s^2] (ISO 80000-3).
inline constexpr double kStandardGravity = 9.80665;

// Arithmetic of three components, evaluated at once. Inside the library these operators are preferred to
// Eigen's expression templates: the components stay in registers (half the instructions of a step), and no
// expression outlives its operands whatever the Scalar.

template <class Scalar>
[[gnu::always_inline]] inline Vector3<Scalar> operator+(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  return {Scalar(a[0] + b[0]), Scalar(a[1] + b[1]), Scalar(a[2] + b[2])};
}

template <class Scalar>
[[gnu::always_inline]] inline Vector3<Scalar> operator-(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  return {Scalar(a[0] - b[0]), Scalar(a[1] - b[1]), Scalar(a[2] - b[2])};
}

template <class Scalar>
[[gnu::always_inline]] inline Vector3<Scalar> operator*(const Vector3<Scalar>& a, const Scalar& s) {
  return {Scalar(a[0] * s), Scalar(a[1] * s), Scalar(a[2] * s)};
}

/// A Scalar may bring its own.
template <class Scalar>
[[gnu::always_inline]] inline Scalar dot(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  if constexpr (requires { Scalar::dot(a, b); })
    return Scalar::dot(a, b);
  else
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Scalar>
[[gnu::always_inline]] inline Vector3<Scalar> cross(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  return {Scalar(a[1] * b[2] - a[2] * b[1]), Scalar(a[2] * b[0] - a[0] * b[2]),
          Scalar(a[0] * b[1] - a[1] * b[0])};
}

template <class Scalar>
[[gnu::always_inline]] inline Scalar squared_norm(const Vector3<Scalar>& a) {
  return dot(a, a);
}

}  // namespace diabolo
