// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/math/polynomial_maximum.hpp"
#include "diabolo/plan/path_limits.hpp"
#include "diabolo/plan/tip_path.hpp"
#include "diabolo/text/expect_positive.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// What the tips may do. For fixed times, each of them is convex in the control points, so that a path
/// between two that keep them keeps them too.
struct TipLimits {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double speed = 4.0;            ///< of either tip [m/s]
  double acceleration = 60.0;    ///< of either tip [m/s^2]
  double jerk = kNone;           ///< of either tip [m/s^3]
  double string_margin = 0.002;  ///< the tips are closer than the string is long by this [m]
  double least_gap = 0.02;       ///< the left tip is to the left of the right one (along y) by this [m]
  Vector3<double> lowest{-10.0, -10.0, -10.0}, highest{10.0, 10.0, 10.0};  ///< corners of the workspace [m]
  PathLimits others{};  ///< whatever else there is, such as a robot's joints and clearances

  /// Throws std::invalid_argument where a limit is not positive or the workspace is empty.
  void validate() const {
    expect_positive("limits, speed", speed, kNone);
    expect_positive("limits, acceleration", acceleration, kNone);
    expect_positive("limits, jerk", jerk, kNone);
    if (!(string_margin >= 0.0 && std::isfinite(string_margin)))
      throw std::invalid_argument("limits, string_margin: " + shown(string_margin) +
                                  " m; must be finite and not negative");
    if (!std::isfinite(least_gap))
      throw std::invalid_argument("limits, least_gap: " + shown(least_gap) + "; must be finite");
    if (lowest.hasNaN() || highest.hasNaN())
      throw std::invalid_argument("limits: a corner of the workspace is not a number");
    if (!((highest - lowest).minCoeff() > 0.0))
      throw std::invalid_argument("limits: the workspace's highest corner must lie above its lowest one");
  }
};

namespace plan_detail {

/// Coefficients of |p|^2 for a polynomial p in three components, in shares of the piece's duration.
template <std::size_t N>
std::array<double, 2 * N - 1> squared(const std::array<Vector3<double>, N>& p) {
  std::array<double, 2 * N - 1> c{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < N; ++k) c[i + k] += p[i].dot(p[k]);
  return c;
}

}  // namespace plan_detail

/// How much the path uses up of each limit, from its exact maxima: within 1e-9, and never too little. The
/// string is `string_length` [m] long.
inline std::vector<LimitUse> limit_uses(const TipPath<double>& path, const TipLimits& limits,
                                        double string_length) {
  std::vector<LimitUse> uses;
  const auto upper = [&uses](std::string name, double limit, const char* unit) {
    uses.push_back({std::move(name), -TipLimits::kNone, limit, unit, 0.0, -1.0});
    return uses.size() - 1;
  };
  const auto raise = [&uses](std::size_t use, double value, double time) {
    if (value > uses[use].value) uses[use].value = value, uses[use].time = time;
  };
  for (int side = 0; side < 2; ++side) {
    const std::string tip = side == 0 ? "left tip " : "right tip ";
    const std::size_t speed = upper(tip + "speed", limits.speed, "m/s"),
                      acceleration = upper(tip + "acceleration", limits.acceleration, "m/s^2"),
                      jerk = upper(tip + "jerk", limits.jerk, "m/s^3");
    for (const TipPiece<double>& piece : path.pieces()) {
      const double h = piece.duration, h2 = h * h;
      std::array<Vector3<double>, 4> c;
      for (std::size_t k = 0; k < 4; ++k) c[k] = piece.c[k].segment<3>(Eigen::Index{3} * side);
      const std::array<Vector3<double>, 3> v{c[1], Vector3<double>(2.0 * h * c[2]),
                                             Vector3<double>(3.0 * h2 * c[3])};
      const PolynomialMaximum fastest = maximum_on_unit_interval(plan_detail::squared(v), 1e-10);
      raise(speed, std::sqrt(fastest.value), piece.begin + fastest.at * h);
      raise(acceleration, (2.0 * c[2]).norm(), piece.begin);  // |a| is convex over a piece
      raise(acceleration, (2.0 * c[2] + 6.0 * h * c[3]).norm(), piece.begin + h);
      raise(jerk, 6.0 * c[3].norm(), piece.begin);
    }
  }
  const std::size_t distance = upper("tip distance", string_length - limits.string_margin, "m"),
                    gap = upper("gap of the tips", -limits.least_gap, "m");
  std::array<std::array<std::size_t, 2>, 6> walls;
  const char axes[] = "xyz";
  for (int k = 0; k < 6; ++k) {
    const std::string name = std::string(k < 3 ? "left tip " : "right tip ") + axes[k % 3];
    walls[static_cast<std::size_t>(k)] = {upper(name + ", highest", limits.highest[k % 3], "m"),
                                          upper(name + ", lowest", -limits.lowest[k % 3], "m")};
  }
  for (const TipPiece<double>& piece : path.pieces()) {
    const double h = piece.duration;
    const auto power = [h](std::size_t k) { return std::pow(h, static_cast<double>(k)); };
    const auto time = [&](const PolynomialMaximum& most) { return piece.begin + most.at * h; };
    std::array<Vector3<double>, 4> apart;
    std::array<double, 4> negative_gap;
    for (std::size_t k = 0; k < 4; ++k) {
      apart[k] = (piece.c[k].head<3>() - piece.c[k].tail<3>()) * power(k);
      negative_gap[k] = -apart[k].y();
    }
    const PolynomialMaximum widest = maximum_on_unit_interval(plan_detail::squared(apart), 1e-10);
    raise(distance, std::sqrt(widest.value), time(widest));
    const PolynomialMaximum closest = maximum_on_unit_interval(negative_gap, 1e-10);
    raise(gap, closest.value, time(closest));
    for (int k = 0; k < 6; ++k)
      for (std::size_t wall = 0; wall < 2; ++wall) {
        std::array<double, 4> c;
        for (std::size_t i = 0; i < 4; ++i) c[i] = (wall == 0 ? 1.0 : -1.0) * piece.c[i][k] * power(i);
        const PolynomialMaximum most = maximum_on_unit_interval(c, 1e-10);
        raise(walls[static_cast<std::size_t>(k)][wall], most.value, time(most));
      }
  }
  for (std::size_t i = 0; i < uses.size(); ++i) {
    LimitUse& use = uses[i];
    const bool relative = use.unit != "m";
    use.excess = !std::isfinite(use.limit) ? -1.0
                 : relative                ? use.value / use.limit - 1.0
                                           : use.value - use.limit;
    const bool lower = use.name == "gap of the tips" || use.name.ends_with("lowest");
    if (lower) use.value = -use.value, use.limit = -use.limit;
  }
  for (LimitUse& use : limits.others(path)) uses.push_back(std::move(use));
  return uses;
}

/// The use that goes farthest beyond its limit, or is nearest to it.
inline const LimitUse& worst(const std::vector<LimitUse>& uses) {
  return *std::ranges::max_element(uses, {}, &LimitUse::excess);
}

/// Whether the path keeps all limits.
inline bool keeps(const TipPath<double>& path, const TipLimits& limits, double string_length) {
  return worst(limit_uses(path, limits, string_length)).excess <= 0.0;
}

}  // namespace diabolo
