// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace diabolo {

/// When a path planned for the times 0 to `length` is played: each instant as many times slower as a cubic
/// B-spline says, so that speed, acceleration and jerk along the path stay continuous or bounded.
class TimeStretch {
 public:
  static constexpr double kKnot = 0.02;  ///< [s] of planned time between the coefficients

  /// Not stretched at all; `length` [s].
  explicit TimeStretch(double length)
      : length_(length), factors_(static_cast<std::size_t>(std::ceil(length / kKnot)) + 3, 1.0) {
    update();
  }

  double length() const { return length_; }            ///< [s] as planned
  double duration() const { return played(length_); }  ///< [s] as played

  /// How many times slower than planned the path runs at a planned time [s]; 1 or more.
  double factor(double planned) const {
    const auto [cell, u] = locate(planned);
    const double* c = &factors_[cell];
    const double v = 1 - u;
    return (c[0] * v * v * v + c[1] * (3 * u * u * u - 6 * u * u + 4) +
            c[2] * (3 * v * v * v - 6 * v * v + 4) + c[3] * u * u * u) /
           6;
  }

  /// When the instant planned for that time is played [s].
  double played(double planned) const {
    const auto [cell, u] = locate(planned);
    const double* c = &factors_[cell];
    const double u2 = u * u, u4 = u2 * u2, v = 1 - u, v4 = v * v * v * v;
    const double within = c[0] * (1 - v4) / 4 + c[1] * (0.75 * u4 - 2 * u2 * u + 4 * u) +
                          c[2] * (-0.75 * u4 + u2 * u + 1.5 * u2 + u) + c[3] * u4 / 4;
    return sums_[cell] + kKnot / 6 * within;
  }

  /// The planned time that is played at a time [s]. `hint` speeds up sequential reading: pass the same
  /// variable again.
  double planned(double time, double& hint) const {
    if (time <= 0) return 0;
    if (time >= duration()) return length_;
    for (int i = 0; i < 50; ++i) {  // Newton's steps; the factor is 1 or more, so they come to rest
      const double step = (time - played(hint)) / factor(hint);
      hint = std::clamp(hint + step, 0.0, length_);
      if (std::abs(step) < 1e-15) break;
    }
    return hint;
  }

  /// The coefficients, `number i` counting most at the planned time (i - 1) * kKnot; change them by scale().
  const std::vector<double>& factors() const { return factors_; }

  /// Multiplies every coefficient by `by`, of as many.
  void scale(const std::vector<double>& by) {
    for (std::size_t i = 0; i < factors_.size(); ++i) factors_[i] *= by[i];
    update();
  }

 private:
  struct Place {
    std::size_t cell;
    double u;
  };

  Place locate(double planned) const {
    const double at = std::clamp(planned, 0.0, length_) / kKnot;
    const std::size_t cell = std::min(static_cast<std::size_t>(at), factors_.size() - 4);
    return {cell, at - static_cast<double>(cell)};
  }

  void update() {
    sums_.assign(factors_.size() - 3, 0.0);
    for (std::size_t i = 0; i + 1 < sums_.size(); ++i)
      sums_[i + 1] =
          sums_[i] +
          kKnot / 24 * (factors_[i] + 11 * factors_[i + 1] + 11 * factors_[i + 2] + factors_[i + 3]);
  }

  double length_;
  std::vector<double> factors_, sums_;  ///< sums: played time at the begin of each cell
};

}  // namespace diabolo
