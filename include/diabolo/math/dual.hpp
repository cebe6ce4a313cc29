// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "diabolo/math/many_slopes.hpp"
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
  static constexpr bool kMany = N >= 12 && std::is_floating_point_v<Slope>;
  using Gradient = std::conditional_t<kMany, ManySlopes<Slope, N>, Eigen::Array<Slope, N, 1>>;
  Base value;         ///< the number itself
  Gradient gradient;  ///< its derivative with respect to each input

  /// Not initialised, as a double is not.
  Dual() {}  // NOLINT: nobody reads it
  // NOLINTNEXTLINE(google-explicit-constructor): constants mix freely with duals
  Dual(double x) : value(Base(x)) {
    if constexpr (!kMany) gradient.setConstant(Slope(0));
  }
  Dual(const Base& x, const Gradient& g) : value(x), gradient(g) {}

  /// The input number `index` with the given value.
  static Dual variable(const Base& x, int index) {
    Dual result(0.0);
    result.value = x;
    result.gradient[index] = Slope(1);
    return result;
  }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend Dual operator-(const Dual& a) { return chain(-a.value, a, Base(-1)); }
  friend Dual operator+(const Dual& a, const Dual& b) {
    Dual result;
    result.set_sum(a, b);
    return result;
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    Dual result;
    result.set_difference(a, b);
    return result;
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual result;
    result.set_product(a, b);
    return result;
  }

  // The same in place.
  void set_sum(const Dual& a, const Dual& b) { set(a.value + b.value, a, Slope(1), b, Slope(1)); }
  void set_difference(const Dual& a, const Dual& b) { set(a.value - b.value, a, Slope(1), b, Slope(-1)); }
  void set_product(const Dual& a, const Dual& b) {
    set(a.value * b.value, a, narrowed(b.value), b, narrowed(a.value));
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
    if constexpr (std::is_same_v<Mask<Base>, bool>) {
      return condition ? a : b;
    } else {
      Dual result;
      result.value = select(condition, a.value, b.value);
      for (int i = 0; i < N; ++i) result.gradient[i] = select(condition, a.gradient[i], b.gradient[i]);
      return result;
    }
  }
  friend Mask<Base> is_finite(const Dual& x) {
    if constexpr (kMany) {
      return is_finite(x.value) && x.gradient.finite();
    } else {
      Mask<Base> finite = is_finite(x.value);
      for (int i = 0; i < N; ++i) finite = finite && is_finite(x.gradient[i]);
      return finite;
    }
  }
  friend bool is_constant_zero(const Dual& x) {
    if (!is_constant_zero(x.value)) return false;
    if constexpr (kMany) {
      return !x.gradient.any();
    } else {
      bool zero = true;
      for (int i = 0; i < N; ++i) zero = zero && is_constant_zero(x.gradient[i]);
      return zero;
    }
  }
  friend Dual constant(const Dual& x) {
    Dual result(0.0);
    result.value = x.value;
    return result;
  }
  friend Base value_of(const Dual& x) { return x.value; }

  static Dual dot(const Vector3<Dual>& a, const Vector3<Dual>& b) requires kMany {
    const auto term = [](const Dual& x, const Dual& by) {
      return typename Gradient::Scaled{x.gradient, narrowed(by.value)};
    };
    Dual result;
    result.value = a[0].value * b[0].value + a[1].value * b[1].value + a[2].value * b[2].value;
    result.gradient =
        typename Gradient::template Sum<6>{term(a[0], b[0]), term(b[0], a[0]), term(a[1], b[1]),
                                           term(b[1], a[1]), term(a[2], b[2]), term(b[2], a[2])};
    return result;
  }

 private:
  /// Kept in the range of a shorter type: an infinity would turn derivatives that are zero into NaN.
  static Slope narrowed(const Base& x) {
    if constexpr (std::is_same_v<Base, Slope>)
      return x;
    else
      return static_cast<Slope>(std::min(std::max(x, Base(-1e30)), Base(1e30)));
  }

  /// Becomes f(a, b), with its derivatives.
  void set(const Base& of, const Dual& a, const Slope& by_a, const Dual& b, const Slope& by_b) {
    value = of;
    if constexpr (kMany)
      gradient = typename Gradient::template Sum<2>{typename Gradient::Scaled{a.gradient, by_a},
                                                    typename Gradient::Scaled{b.gradient, by_b}};
    else
      gradient = a.gradient * by_a + b.gradient * by_b;
  }
  static Dual chain(const Base& value, const Dual& a, const Base& by_a, const Dual& b, const Base& by_b) {
    Dual result;
    result.set(value, a, narrowed(by_a), b, narrowed(by_b));
    return result;
  }
  /// f(a), with its derivative.
  static Dual chain(const Base& value, const Dual& a, const Base& slope) {
    Dual result;
    result.value = value;
    if constexpr (kMany)
      result.gradient = typename Gradient::Scaled{a.gradient, narrowed(slope)};
    else
      result.gradient = a.gradient * narrowed(slope);
    return result;
  }
};

// Each component in place, without a copy of its derivatives.

template <class Base, int N, class Slope>
Vector3<Dual<Base, N, Slope>> operator+(const Vector3<Dual<Base, N, Slope>>& a,
                                        const Vector3<Dual<Base, N, Slope>>& b) {
  Vector3<Dual<Base, N, Slope>> sum;
  for (int i = 0; i < 3; ++i) sum[i].set_sum(a[i], b[i]);
  return sum;
}
template <class Base, int N, class Slope>
Vector3<Dual<Base, N, Slope>> operator-(const Vector3<Dual<Base, N, Slope>>& a,
                                        const Vector3<Dual<Base, N, Slope>>& b) {
  Vector3<Dual<Base, N, Slope>> difference;
  for (int i = 0; i < 3; ++i) difference[i].set_difference(a[i], b[i]);
  return difference;
}
template <class Base, int N, class Slope>
Vector3<Dual<Base, N, Slope>> operator*(const Vector3<Dual<Base, N, Slope>>& a,
                                        const Dual<Base, N, Slope>& s) {
  Vector3<Dual<Base, N, Slope>> product;
  for (int i = 0; i < 3; ++i) product[i].set_product(a[i], s);
  return product;
}

template <class Base, int N, class Slope>
inline constexpr bool kManyDerivatives<Dual<Base, N, Slope>> = N >= 8;

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
