// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cstddef>
#include <vector>

namespace plant {

/// Twice continuously differentiable cubic spline through `Size` quantities at rising knot times, at rest at
/// both ends and constant beyond them.
template <int Size>
class CubicSpline {
 public:
  using Values = Eigen::Matrix<double, Size, 1>;

  /// Value and time derivatives.
  struct Sample {
    Values value;
    Values rate;
    Values second_rate;
  };

  CubicSpline(std::vector<double> times, std::vector<Values> values)
      : times_(std::move(times)), values_(std::move(values)), bends_(solve_second_rates()) {}

  double start() const { return times_.front(); }
  double end() const { return times_.back(); }

  Sample at(double time) const {
    if (time <= start()) return {values_.front(), Values::Zero(), Values::Zero()};
    if (time >= end()) return {values_.back(), Values::Zero(), Values::Zero()};
    const auto after = std::upper_bound(times_.begin(), times_.end(), time);
    const std::size_t i = static_cast<std::size_t>(after - times_.begin()) - 1;
    const double h = times_[i + 1] - times_[i];
    const double b = (time - times_[i]) / h;
    const double a = 1.0 - b;
    const Values slope = (values_[i + 1] - values_[i]) / h;
    return {a * values_[i] + b * values_[i + 1] +
                h * h / 6.0 * ((a * a * a - a) * bends_[i] + (b * b * b - b) * bends_[i + 1]),
            slope + h / 6.0 * ((1.0 - 3.0 * a * a) * bends_[i] + (3.0 * b * b - 1.0) * bends_[i + 1]),
            a * bends_[i] + b * bends_[i + 1]};
  }

 private:
  /// Second derivatives at the knots: the tridiagonal system of continuous slopes, by forward elimination.
  std::vector<Values> solve_second_rates() const {
    const std::size_t count = times_.size();
    std::vector<double> upper(count);
    std::vector<Values> bends(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double before = i > 0 ? times_[i] - times_[i - 1] : 0.0;
      const double after = i + 1 < count ? times_[i + 1] - times_[i] : 0.0;
      const Values slope_before = i > 0 ? Values((values_[i] - values_[i - 1]) / before) : Values::Zero();
      const Values slope_after =
          i + 1 < count ? Values((values_[i + 1] - values_[i]) / after) : Values::Zero();
      const double pivot = 2.0 * (before + after) - (i > 0 ? before * upper[i - 1] : 0.0);
      const Values carried = i > 0 ? Values(before * bends[i - 1]) : Values::Zero();
      upper[i] = after / pivot;
      bends[i] = (6.0 * (slope_after - slope_before) - carried) / pivot;
    }
    for (std::size_t i = count - 1; i-- > 0;) bends[i] -= upper[i] * bends[i + 1];
    return bends;
  }

  std::vector<double> times_;
  std::vector<Values> values_;
  std::vector<Values> bends_;  // second derivatives
};

}  // namespace plant
