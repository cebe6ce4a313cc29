// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace diabolo {

/// First derivatives at both ends of a clamped spline.
template <class Column>
struct EndSlopes {
  Column first, last;
};

/// Second derivatives at the n knots of the cubic spline through the columns `y` (n), `h` (n - 1) apart, by
/// Thomas's algorithm. Natural, with zero curvature at its ends, where no `slopes` are given; at least two
/// knots.
template <class Width, class Column>
std::vector<Column> spline_curvatures(const std::vector<Width>& h, const std::vector<Column>& y,
                                      const std::optional<EndSlopes<Column>>& slopes = {}) {
  using Scalar = typename Column::Scalar;
  const std::size_t n = y.size(), first = slopes ? 0 : 1, end = slopes ? n : n - 1;
  const auto slope_after = [&](std::size_t i) {
    return i + 1 < n ? Column((y[i + 1] - y[i]) * Scalar(Width(6.0) / h[i]))
                     : Column(slopes->last * Scalar(6.0));
  };
  std::vector<Width> upper(n, Width(0.0));
  std::vector<Column> m(n, Column::Constant(Scalar(0)));
  if (first >= end) return m;
  Column before = slopes ? Column(slopes->first * Scalar(6.0)) : slope_after(0);
  for (std::size_t i = first; i < end; ++i) {
    const Width left = i > 0 ? h[i - 1] : Width(0.0), right = i + 1 < n ? h[i] : Width(0.0);
    Width pivot = Width(2.0) * (left + right);
    const Column after = slope_after(i);
    Column rest = after - before;
    if (i > 0) {
      pivot = pivot - left * upper[i - 1];
      rest = rest - m[i - 1] * Scalar(left);
    }
    upper[i] = right / pivot;
    m[i] = rest * Scalar(Width(1.0) / pivot);
    before = after;
  }
  for (std::size_t i = end; i-- > first;)
    if (i + 1 < n) m[i] -= m[i + 1] * Scalar(upper[i]);
  return m;
}

/// A cubic spline at a place between two of its knots.
template <class Column>
struct SplinePoint {
  Column value, rate;
};

/// The spline at the share `v` of the way between two knots, `h` apart, with these values and second
/// derivatives.
template <class Column>
SplinePoint<Column> spline_point(const Column& a, const Column& b, const Column& curvature_a,
                                 const Column& curvature_b, double h, double v) {
  using Scalar = typename Column::Scalar;
  const double u = 1.0 - v, h2 = h * h / 6.0;
  SplinePoint<Column> point{a * Scalar(u) + b * Scalar(v), (b - a) * Scalar(1.0 / h)};
  point.value += curvature_a * Scalar((u * u - 1.0) * u * h2) + curvature_b * Scalar((v * v - 1.0) * v * h2);
  point.rate += curvature_a * Scalar((1.0 - 3.0 * u * u) * h / 6.0) +
                curvature_b * Scalar((3.0 * v * v - 1.0) * h / 6.0);
  return point;
}

}  // namespace diabolo
