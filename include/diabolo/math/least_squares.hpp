// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "diabolo/math/solve_symmetric.hpp"

namespace diabolo {

/// Residuals at a point, and their derivatives.
struct Linearization {
  Eigen::VectorXd residuals;  ///< n
  Eigen::MatrixXd jacobian;   ///< n x unknowns
};

namespace math_detail {

/// The Levenberg-Marquardt step that is no longer than `radius`: damped just so much, or as much as could be
/// tried before `stop()`.
template <class Stop>
Eigen::VectorXd step_within(const Eigen::MatrixXd& normal, const Eigen::VectorXd& slope, double radius,
                            const Stop& stop) {
  const double largest = std::max(normal.diagonal().maxCoeff(), 1e-12);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(slope.size());
  constexpr int kDampings = 25;  // from 1e-9 on, four times more each
  for (int i = 0; i < kDampings && !stop(); ++i) {
    Eigen::MatrixXd damped = normal;
    damped.diagonal().array() += std::ldexp(1e-9 * largest, 2 * i);
    step = -solve_symmetric(damped, slope).col(0);
    if (step.norm() <= radius) break;
  }
  return step;
}

}  // namespace math_detail

/// Levenberg and Marquardt's method in a trust region, within bounds |x_i| <= bounds_i: makes sum r_i(x)^2
/// small from `x` on and returns the sum. `value(x)` gives the sum, `linearize(x)` the residuals with
/// derivatives, `stop()` ends the search, which starts with steps of length `radius`. Ends by itself after
/// `iterations`, or when one gains less than the share `least_gain`.
template <class Value, class Linearize, class Stop>
double least_squares(std::vector<double>& x, const std::vector<double>& bounds, int iterations, double radius,
                     double least_gain, const Value& value, const Linearize& linearize, const Stop& stop) {
  const Eigen::Index n = static_cast<Eigen::Index>(x.size());
  double sum = INFINITY;
  for (int iteration = 0; n > 0 && iteration < iterations && !stop(); ++iteration) {
    const Linearization at = linearize(x);
    if (stop()) return sum;
    sum = at.residuals.squaredNorm();
    if (!std::isfinite(sum) || !at.jacobian.allFinite()) return sum;
    Eigen::MatrixXd normal = at.jacobian.transpose() * at.jacobian;
    Eigen::VectorXd slope = at.jacobian.transpose() * at.residuals;
    for (Eigen::Index i = 0; i < n; ++i) {  // an unknown at its bound that would go beyond stays
      const double position = x[static_cast<std::size_t>(i)], bound = bounds[static_cast<std::size_t>(i)];
      if (std::abs(position) < bound || position * slope[i] > 0.0) continue;
      normal.row(i).setZero();
      normal.col(i).setZero();
      slope[i] = 0.0;
    }
    bool gained = false, settled = false;
    for (int attempt = 0; attempt < 7 && !gained && !stop(); ++attempt) {
      const Eigen::VectorXd step = math_detail::step_within(normal, slope, radius, stop);
      if (!step.allFinite()) return sum;  // residuals so large that their squares overflow
      std::vector<double> next = x;
      for (Eigen::Index i = 0; i < n; ++i) {
        const std::size_t k = static_cast<std::size_t>(i);
        next[k] = std::clamp(x[k] + step[i], -bounds[k], bounds[k]);
      }
      const double there = value(next);
      const double promised = sum - (at.residuals + at.jacobian * step).squaredNorm();
      const double ratio = (sum - there) / std::max(promised, 1e-300);
      if (ratio < 0.25) radius = 0.3 * std::min(radius, step.norm());
      if (ratio > 0.7) radius = std::max(radius, 2.0 * step.norm());
      if (!(there < sum)) continue;
      settled = sum - there < least_gain * sum;
      gained = true;
      x = next;
      sum = there;
    }
    if (!gained || settled) break;
  }
  return sum;
}

}  // namespace diabolo
