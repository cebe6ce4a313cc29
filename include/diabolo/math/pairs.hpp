// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <concepts>

namespace diabolo {

// Roots and quotients of two numbers at once, bit for bit as one by one. They take longest of all in a step;
// for doubles the processor does both in the time of one.

typedef double TwoDoubles __attribute__((vector_size(2 * sizeof(double))));

template <class Scalar>
[[gnu::always_inline]] inline std::array<Scalar, 2> square_roots(const Scalar& a, const Scalar& b) {
  using std::sqrt;
  if constexpr (std::same_as<Scalar, double>) {
    const TwoDoubles both = {a, b};
    const Eigen::Array2d roots =
        Eigen::Map<const Eigen::Array2d, Eigen::Aligned16>(reinterpret_cast<const double*>(&both)).sqrt();
    return {roots[0], roots[1]};
  } else {
    return {sqrt(a), sqrt(b)};
  }
}

/// a / c and b / d.
template <class Scalar>
[[gnu::always_inline]] inline std::array<Scalar, 2> quotients(const Scalar& a, const Scalar& b,
                                                              const Scalar& c, const Scalar& d) {
  if constexpr (std::same_as<Scalar, double>) {
    const TwoDoubles both = TwoDoubles{a, b} / TwoDoubles{c, d};
    return {both[0], both[1]};
  } else {
    return {Scalar(a / c), Scalar(b / d)};
  }
}

/// 1 / a and 1 / b.
template <class Scalar>
[[gnu::always_inline]] inline std::array<Scalar, 2> inverses(const Scalar& a, const Scalar& b) {
  return quotients(Scalar(1), Scalar(1), a, b);
}

}  // namespace diabolo
