// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <limits>

#include "diabolo/math/pairs.hpp"
#include "diabolo/math/vector3.hpp"

namespace diabolo {

/// # The Scalar contract
/// Every law of the library is a template over `Scalar`: double, float, `Dual` (derivatives), `Pack` (SIMD
/// lanes), or a type of yours. Needed of it, and shown by tests/laws/foreign_scalar.cpp to be enough:
///
/// - a default constructor, copies, and construction from double, which may be explicit;
/// - + - * / of two Scalars, unary -, += and -=;
/// - < > <= >= == on the value, which give its `Mask`: bool, or a type of yours with construction from bool,
///   && || !, and `any(mask)`, `all(mask)`;
/// - by argument-dependent lookup `sqrt exp`, and for the effects `log tanh atan2 sin cos`;
/// - likewise `select(mask, a, b)`, `is_finite(x)`, a Mask, and `is_constant_zero(x)`, a bool, as below;
/// - specialisations of `ScalarTraits`, as below, and of Eigen::NumTraits.
///
/// Rules of the house: `using std::sqrt;` then unqualified calls; never `auto` for a Scalar or an Eigen
/// expression; `Scalar(0.5)` beside a Scalar; branch on values only where both sides agree at the switch,
/// else `select`; keep every argument of sqrt above zero (`positive_sqrt`).
template <class Scalar>
struct ScalarTraits;

template <std::floating_point Float>
struct ScalarTraits<Float> {
  using Mask = bool;    ///< result of a comparison
  using Value = Float;  ///< the number behind derivatives and lanes
  static constexpr int kLanes = 1;
};

/// What a comparison of two Scalars gives: bool, or a bool per lane.
template <class Scalar>
using Mask = typename ScalarTraits<Scalar>::Mask;

/// The floating-point type underneath a Scalar.
template <class Scalar>
using ValueOf = typename ScalarTraits<Scalar>::Value;

/// The value without derivatives.
template <std::floating_point Float>
constexpr Float value_of(Float x) {
  return x;
}

/// The number behind a Scalar with one lane, as a double.
template <class Scalar>
double plain(const Scalar& x) {
  return static_cast<double>(value_of(x));
}

/// `a` where `condition` holds, else `b`; evaluates both.
template <std::floating_point Float>
constexpr Float select(bool condition, Float a, Float b) {
  return condition ? a : b;
}

template <std::floating_point Float>
bool is_finite(Float x) {
  return std::isfinite(x);
}

/// Whether the number is zero and stays zero: no lane and no derivative differs from zero.
template <std::floating_point Float>
constexpr bool is_constant_zero(Float x) {
  return x == Float(0);
}

/// Whether a Scalar carries so many derivatives that they cost more than all else.
template <class Scalar>
inline constexpr bool kManyDerivatives = false;

/// Without derivatives, for what is only compared.
template <class Scalar>
constexpr const Scalar& constant(const Scalar& x) {
  return x;
}
template <class Scalar>
[[gnu::always_inline]] inline Vector3<Scalar> constant(const Vector3<Scalar>& v) {
  return {constant(v[0]), constant(v[1]), constant(v[2])};
}

constexpr bool any(bool condition) { return condition; }
constexpr bool all(bool condition) { return condition; }

/// Lane-wise choice between two vectors.
template <class Scalar>
[[gnu::always_inline]] inline Vector3<Scalar> select(const Mask<Scalar>& condition, const Vector3<Scalar>& a,
                                                     const Vector3<Scalar>& b) {
  return {select(condition, a.x(), b.x()), select(condition, a.y(), b.y()), select(condition, a.z(), b.z())};
}

template <class Scalar>
Scalar minimum(const Scalar& a, const Scalar& b) {
  return select(a < b, a, b);
}

template <class Scalar>
Scalar maximum(const Scalar& a, const Scalar& b) {
  return select(a < b, b, a);
}

template <class Scalar>
Scalar absolute(const Scalar& x) {
  return select(x < Scalar(0), Scalar(-x), x);
}

/// A number that is nothing beside any physical quantity and whose square root has a finite inverse.
template <class Scalar>
Scalar tiny() {
  return Scalar(static_cast<double>(std::numeric_limits<ValueOf<Scalar>>::min()) * 1e6);
}

/// Square root of max(x, 0), its argument kept above zero so that derivatives stay finite.
template <class Scalar>
Scalar positive_sqrt(const Scalar& x) {
  using std::sqrt;
  return sqrt(maximum(x, tiny<Scalar>()));
}

/// Euclidean norm with finite derivatives at zero.
template <class Scalar>
[[gnu::always_inline]] inline Scalar norm(const Vector3<Scalar>& v) {
  using std::sqrt;
  return sqrt(squared_norm(v) + tiny<Scalar>());
}

/// The norms of two vectors.
template <class Scalar>
[[gnu::always_inline]] inline std::array<Scalar, 2> norms(const Vector3<Scalar>& a,
                                                          const Vector3<Scalar>& b) {
  return square_roots(Scalar(squared_norm(a) + tiny<Scalar>()), Scalar(squared_norm(b) + tiny<Scalar>()));
}

/// Agreement that the string's constraint is solved to, relative to the string's length.
template <class Scalar>
constexpr double constraint_tolerance() {
  return sizeof(ValueOf<Scalar>) >= sizeof(double) ? 1e-10 : 2e-6;
}

}  // namespace diabolo
