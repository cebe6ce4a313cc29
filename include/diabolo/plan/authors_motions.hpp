// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "diabolo/plan/goals.hpp"
#include "diabolo/plan/stick_spline.hpp"

namespace diabolo {

/// The length of the authors' string on their robots, for which their motions were made [m].
inline constexpr double kAuthorsStringLength = 1.58;

namespace plan_detail {

/// Both tips across the player, x being `forward`.
inline TipColumn<double> tips_column(double forward, double left_y, double left_z, double right_y,
                                     double right_z) {
  TipColumn<double> column;
  column << forward, left_y, left_z, forward, right_y, right_z;
  return column;
}

/// A motion from `home` through offsets of it at the given times [s].
inline StickSpline<double> through(const TipColumn<double>& home, const std::vector<double>& times,
                                   const std::vector<TipColumn<double>>& offsets, double size, double pace) {
  StickSpline<double> spline;
  spline.points.push_back(home);
  double before = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    spline.points.push_back(home + offsets[i] * size);
    spline.durations.push_back((times[i] - before) / pace);
    before = times[i];
  }
  return spline;
}

/// Offsets that both tips make together (y, z), and apart from each other.
inline std::vector<TipColumn<double>> together(std::initializer_list<std::array<double, 3>> moves) {
  std::vector<TipColumn<double>> offsets;
  for (const auto& [y, z, apart] : moves) offsets.push_back(tips_column(0.0, y + apart, z, y - apart, z));
  return offsets;
}

}  // namespace plan_detail

/// The authors' linear acceleration: the right hand pulls up while the left one sinks, and back.
inline StickSpline<double> authors_linear_acceleration(const TipColumn<double>& home, double size,
                                                       double pace) {
  return plan_detail::through(
      home, {0.25, 0.5, 0.9, 1.2},
      {plan_detail::tips_column(0.0, -0.05, -0.15, 0.05, 0.2),
       plan_detail::tips_column(0.0, 0.0, -0.3, 0.0, 0.4),
       plan_detail::tips_column(0.0, -0.05, -0.15, 0.05, 0.2), TipColumn<double>::Zero()},
      size, pace);
}

/// The authors' circular acceleration: the hands follow each other around, the diabolo runs below them.
inline StickSpline<double> authors_circular_acceleration(const TipColumn<double>& home, double size,
                                                         double pace) {
  return plan_detail::through(
      home, {0.35, 0.65, 0.95, 1.25, 1.55, 1.85},
      {plan_detail::tips_column(0.0, -0.061, 0.1801, -0.042, 0.2),
       plan_detail::tips_column(0.0, 0.0592, 0.382, -0.24, 0.3),
       plan_detail::tips_column(0.0, 0.2619, 0.344, -0.41, 0.2),
       plan_detail::tips_column(0.0, 0.31, 0.15914, -0.371, 0.0),
       plan_detail::tips_column(0.0, 0.141, 0.03543, -0.163, -0.076), TipColumn<double>::Zero()},
      size, pace);
}

/// The authors' vertical throw: both hands part in three strides, level with each other.
inline StickSpline<double> authors_throw(const TipColumn<double>& home) {
  return plan_detail::through(home, {0.4, 0.8, 0.92},
                              plan_detail::together({{0.0, 0.0, 0.2}, {0.0, 0.0, 0.65}, {0.0, 0.0, 0.731}}),
                              1.0, 1.0);
}

/// The authors' horizontal impulse, which prepares others: both hands sway from side to side.
inline StickSpline<double> authors_horizontal_impulse(const TipColumn<double>& home) {
  return plan_detail::through(
      home, {0.9, 1.4, 2.0, 2.8, 3.5},
      plan_detail::together(
          {{0.23, 0.0, 0.0}, {0.12, 0.0, 0.0}, {-0.12, 0.0, 0.0}, {0.23, 0.0, 0.0}, {0.0, 0.0, 0.0}}),
      1.0, 1.0);
}

/// The authors' goals of a round of circular acceleration, base and four more states, scaled with the string
/// about the middle of the tips.
inline std::vector<Waypoint> authors_circle_goals(double string_length) {
  const double s = string_length / kAuthorsStringLength;
  const auto state = [s](double y, double z, double vy, double vz) {
    Waypoint w;
    w.position = {0.55, s * y, 1.25 + s * (z - 1.27)};
    w.velocity = {0.0, std::sqrt(s) * vy, std::sqrt(s) * vz};
    w.position_weight = 1.0;
    w.velocity_weight = 0.1;
    w.direction_weight = 0.1;
    return w;
  };
  return {state(0.2618, 0.71991, -0.5, 1.0), state(0.1618, 0.91991, -1.0, 0.1),
          state(-0.3382, 0.91991, -0.5, -0.5), state(-0.4382, 0.71991, 1.0, -0.5)};
}

}  // namespace diabolo
