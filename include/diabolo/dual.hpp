// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "diabolo/scalar.hpp"

namespace diabolo {

/// A forward-mode dual number: a value and its derivatives with respect to N inputs, carried through every
/// operation by the chain rule. `Base` is double, float or a `Pack`. Comparisons look at the value only.
///
///     using D = diabolo::Dual<double, 2>;
///     D x = D::variable(3.0, 0), y = D::variable(4.0, 1);
///     D r = sqrt(x * x + y * y);   // r.value == 5, r.gradient == (0.6, 0.8)
template <class Base, int N>
struct Dual {
  using Gradient = Eigen::Array<Base, N, 1>;
  Base value{0};                                    ///< the number itself
  Gradient gradient = Gradient::Constant(Base(0));  ///< its derivative with respect to each input

  Dual() = default;
  Dual(double x) : value(Base(x)) {}  // NOLINT: constants mix freely with duals
  Dual(const Base& x, const Gradient& g) : value(x), gradient(g) {}

  /// The input number `index` with the given value.
  static Dual variable(const Base& x, int index) {
    Dual result(x, Gradient::Constant(Base(0)));
    result.gradient[index] = Base(1);
    return result;
  }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend Dual operator-(const Dual& a) { return {-a.value, -a.gradient}; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.gradient + b.gradient}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.gradient - b.gradient}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.gradient * b.value + b.gradient * a.value};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const Base inverse = Base(1) / b.value;
    const Base quotient = a.value * inverse;
    return {quotient, (a.gradient - b.gradient * quotient) * inverse};
  }

  friend Mask<Base> operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend Mask<Base> operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
  friend Mask<Base> operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  friend Mask<Base> operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }
  friend Mask<Base> operator==(const Dual& a, const Dual& b) { return a.value == b.value; }
  friend Mask<Base> operator!=(const Dual& a, const Dual& b) { return a.value != b.value; }

  friend Dual sqrt(const Dual& x) {
    using std::sqrt;
    const Base root = sqrt(x.value);
    return {root, x.gradient * (Base(0.5) / root)};
  }
  friend Dual exp(const Dual& x) {
    using std::exp;
    const Base power = exp(x.value);
    return {power, x.gradient * power};
  }
  friend Dual sin(const Dual& x) {
    using std::cos;
    using std::sin;
    return {sin(x.value), x.gradient * cos(x.value)};
  }
  friend Dual cos(const Dual& x) {
    using std::cos;
    using std::sin;
    return {cos(x.value), x.gradient * (-sin(x.value))};
  }
  friend Dual tanh(const Dual& x) {
    using std::tanh;
    const Base t = tanh(x.value);
    return {t, x.gradient * (Base(1) - t * t)};
  }
  friend Dual atan2(const Dual& y, const Dual& x) {
    using std::atan2;
    const Base inverse = Base(1) / (x.value * x.value + y.value * y.value);
    return {atan2(y.value, x.value), (y.gradient * x.value - x.gradient * y.value) * inverse};
  }

  friend Dual select(const Mask<Base>& condition, const Dual& a, const Dual& b) {
    Dual result;
    result.value = select(condition, a.value, b.value);
    for (int i = 0; i < N; ++i) result.gradient[i] = select(condition, a.gradient[i], b.gradient[i]);
    return result;
  }
  friend Mask<Base> is_finite(const Dual& x) {
    Mask<Base> finite = is_finite(x.value);
    for (int i = 0; i < N; ++i) finite = finite && is_finite(x.gradient[i]);
    return finite;
  }
  friend bool is_constant_zero(const Dual& x) {
    bool zero = is_constant_zero(x.value);
    for (int i = 0; i < N; ++i) zero = zero && is_constant_zero(x.gradient[i]);
    return zero;
  }
  friend Base value_of(const Dual& x) { return x.value; }
};

template <class Base, int N>
struct ScalarTraits<Dual<Base, N>> {
  using Mask = diabolo::Mask<Base>;
  using Value = ValueOf<Base>;
  static constexpr int kLanes = ScalarTraits<Base>::kLanes;
};

}  // namespace diabolo

template <class Base, int N>
struct Eigen::NumTraits<diabolo::Dual<Base, N>> : Eigen::GenericNumTraits<diabolo::Dual<Base, N>> {
  using Real = diabolo::Dual<Base, N>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = N,
    AddCost = N,
    MulCost = 3 * N
  };
};
