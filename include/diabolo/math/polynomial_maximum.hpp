// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace diabolo {

/// Where a polynomial is largest, and how large.
struct PolynomialMaximum {
  double value;  ///< never below the true maximum; infinite where a coefficient is too large for it or none
  double at;     ///< an argument where the polynomial comes within the tolerance of it
};

namespace math_detail {

/// Control values of a polynomial in Bernstein's form: it lies within their range, touches the first and the
/// last, and comes closer to them the shorter the interval is (de Casteljau).
template <std::size_t N>
struct BernsteinPiece {
  std::array<double, N> values;
  double begin, length;

  BernsteinPiece halved(bool second) const {
    std::array<double, N> work = values, left, right;
    for (std::size_t k = 0; k < N; ++k) {
      left[k] = work[0];
      right[N - 1 - k] = work[N - 1 - k];
      for (std::size_t i = 0; i + 1 < N - k; ++i) work[i] = 0.5 * (work[i] + work[i + 1]);
    }
    return {second ? right : left, second ? begin + 0.5 * length : begin, 0.5 * length};
  }
};

}  // namespace math_detail

/// The maximum of c[0] + c[1] s + ... over 0 <= s <= 1, found by halving the interval where it may lie.
/// `tolerance` is absolute; what is returned lies above the truth by no more than that and what rounding may
/// do, and never below, but for rounding.
template <std::size_t N>
PolynomialMaximum maximum_on_unit_interval(const std::array<double, N>& c, double tolerance) {
  using Piece = math_detail::BernsteinPiece<N>;
  Piece whole{{}, 0.0, 1.0};
  for (std::size_t i = 0; i < N; ++i) {
    double share = 1.0;  // binomial(i, k) / binomial(N - 1, k)
    for (std::size_t k = 0; k <= i; ++k) {
      whole.values[i] += share * c[k];
      share *= static_cast<double>(i - k) / static_cast<double>(N - 1 - k > 0 ? N - 1 - k : 1);
    }
  }
  double largest = 0.0;
  for (const double value : whole.values)
    largest = std::isfinite(value) ? std::max(largest, std::abs(value)) : INFINITY;
  if (largest == INFINITY) return {INFINITY, 0.0};
  tolerance = std::max(tolerance, 1e-13 * largest);
  PolynomialMaximum best{whole.values.front(), 0.0};
  std::vector<Piece> open{whole};
  double bound = best.value;  // of what was put aside
  while (!open.empty()) {
    const Piece piece = open.back();
    open.pop_back();
    if (piece.values.front() > best.value) best = {piece.values.front(), piece.begin};
    if (piece.values.back() > best.value) best = {piece.values.back(), piece.begin + piece.length};
    const double most = *std::ranges::max_element(piece.values);
    if (most <= best.value + tolerance || piece.length < 1e-12)
      bound = std::max(bound, most);
    else
      for (const bool second : {false, true}) open.push_back(piece.halved(second));
  }
  return {std::max(best.value, bound), best.at};
}

}  // namespace diabolo
