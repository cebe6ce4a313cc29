// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "diabolo/math/scalar.hpp"

namespace diabolo {

/// A forward-mode dual number: a value and its derivatives with respect to N inputs, carried through every
/// operation by the chain rule. `Base` is double, float or a `Pack`; the derivatives may be of a shorter
/// type, float. Comparisons look at the value only.
///
///     using D = diabolo::Dual<double, 2>;
///     D x = D::variable(3.0, 0), y = D::variable(4.0, 1);
///     D r = sqrt(x * x + y * y);   // r.value == 5, r.gradient == (0.6, 0.8)
template <class Base, int N, class Slope = Base>
struct Dual {
  using Gradient = Eigen::Array<Slope, N, 1>;
  Base value;         ///< the number itself
  Gradient gradient;  ///< its derivative with respect to each input

  /// Not initialised, as a double is not.
  Dual() {}  // NOLINT: filling long gradients with zeros took a third of a rollout's time
  // NOLINTNEXTLINE(google-explicit-constructor): constants mix freely with duals
  Dual(double x) : value(Base(x)) {
    run([&]() { gradient.setConstant(Slope(0)); });
  }
  Dual(const Base& x, const Gradient& g) : value(x), gradient(g) {}

  /// The input number `index` with the given value.
  static Dual variable(const Base& x, int index) {
    Dual result(x, Gradient::Constant(Slope(0)));
    result.gradient[index] = Slope(1);
    return result;
  }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend Dual operator-(const Dual& a) { return {-a.value, -a.gradient}; }
  friend Dual operator+(const Dual& a, const Dual& b) {
    Dual result(Raw{}, a.value + b.value);
    run([&]() { result.gradient = a.gradient + b.gradient; });
    return result;
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    Dual result(Raw{}, a.value - b.value);
    run([&]() { result.gradient = a.gradient - b.gradient; });
    return result;
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return chain(a.value * b.value, a, b.value, b, a.value);
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const Base inverse = Base(1) / b.value;
    const Base quotient = a.value * inverse;
    return chain(quotient, a, inverse, b, -quotient * inverse);
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
    return chain(root, x, Base(0.5) / root);
  }
  friend Dual exp(const Dual& x) {
    using std::exp;
    const Base power = exp(x.value);
    return chain(power, x, power);
  }
  friend Dual log(const Dual& x) {
    using std::log;
    return chain(log(x.value), x, Base(1) / x.value);
  }
  friend Dual sin(const Dual& x) {
    using std::cos;
    using std::sin;
    return chain(sin(x.value), x, cos(x.value));
  }
  friend Dual cos(const Dual& x) {
    using std::cos;
    using std::sin;
    return chain(cos(x.value), x, -sin(x.value));
  }
  friend Dual tanh(const Dual& x) {
    using std::tanh;
    const Base t = tanh(x.value);
    return chain(t, x, Base(1) - t * t);
  }
  friend Dual atan2(const Dual& y, const Dual& x) {
    using std::atan2;
    const Base inverse = Base(1) / (x.value * x.value + y.value * y.value);
    return chain(atan2(y.value, x.value), y, x.value * inverse, x, -y.value * inverse);
  }

  friend Dual select(const Mask<Base>& condition, const Dual& a, const Dual& b) {
    if constexpr (std::is_same_v<Mask<Base>, bool>) return condition ? a : b;
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
    if (!is_constant_zero(x.value)) return false;
    bool zero = true;
    for (int i = 0; i < N; ++i) zero = zero && is_constant_zero(x.gradient[i]);
    return zero;
  }
  friend Base value_of(const Dual& x) { return x.value; }

 private:
  /// Kept in the range of a shorter type: an infinity would turn derivatives that are zero into NaN.
  static Slope narrowed(const Base& x) {
    if constexpr (std::is_same_v<Base, Slope>)
      return x;
    else
      return static_cast<Slope>(std::clamp(x, Base(-1e30), Base(1e30)));
  }

  struct Raw {};
  Dual(Raw, const Base& x) : value(x) {}  // the gradient is about to be written

  /// f(a), with its derivative.
  static Dual chain(const Base& value, const Dual& a, const Base& slope) {
    Dual result(Raw{}, value);
    run([&]() { result.gradient = a.gradient * narrowed(slope); });
    return result;
  }
  /// f(a, b), with its derivatives.
  static Dual chain(const Base& value, const Dual& a, const Base& by_a, const Dual& b, const Base& by_b) {
    Dual result(Raw{}, value);
    run([&]() { result.gradient = a.gradient * narrowed(by_a) + b.gradient * narrowed(by_b); });
    return result;
  }

  /// Work on gradients. On long ones it is not inlined: a call costs less than code that no cache holds.
  template <class Work>
  [[gnu::always_inline]] static void run(const Work& work) {
    if constexpr (N < kLong)
      work();
    else
      run_apart(work);
  }
  template <class Work>
  [[gnu::noinline]] static void run_apart(const Work& work) {
    work();
  }
  static constexpr int kLong = 12;
};

template <class Base, int N, class Slope>
struct ScalarTraits<Dual<Base, N, Slope>> {
  using Mask = diabolo::Mask<Base>;
  using Value = ValueOf<Base>;
  static constexpr int kLanes = ScalarTraits<Base>::kLanes;
};

}  // namespace diabolo

template <class Base, int N, class Slope>
struct Eigen::NumTraits<diabolo::Dual<Base, N, Slope>>
    : Eigen::GenericNumTraits<diabolo::Dual<Base, N, Slope>> {
  using Real = diabolo::Dual<Base, N, Slope>;
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
