// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/player/goals.hpp"
#include "diabolo/player/motion_unknowns.hpp"
#include "diabolo/recording/baseline.hpp"
#include "diabolo/state.hpp"

namespace diabolo {

/// The length of the authors' string on their robots, for which their motions were made [m].
inline constexpr double kAuthorsStringLength = 1.58;

/// A figure of play: a seed motion of the tips, what the solver may change of it, and what it shall lead to.
/// It starts and ends with the tips at rest.
struct Action {
  std::string name;
  StickSpline<double> seed;
  Freedom freedom{};
  Goals goals{};
};

/// What can be asked of an action.
struct ActionOptions {
  double size = 1.0;             ///< of the hands' motion, as a share of the usual one
  double pace = 1.0;             ///< its speed, likewise
  double height = 0.5;           ///< of hops over the start, of throws above the tips [m]
  double sideways = 0.3;         ///< of swings and throws to the side, to the left [m]
  std::optional<double> spin{};  ///< to be gained by a cycle of acceleration [rad/s]; needs string friction

  /// Throws std::invalid_argument where one is out of its range.
  void validate() const {
    const auto check = [](const char* name, double value, double low, double high) {
      if (value >= low && value <= high) return;
      throw std::invalid_argument(std::string("action, ") + name + ": " + std::to_string(value) +
                                  "; must be within " + std::to_string(low) + " and " + std::to_string(high));
    };
    check("size", size, 0.1, 3.0);
    check("pace", pace, 0.2, 5.0);
    check("height", height, 0.01, 5.0);
    check("sideways", sideways, -2.0, 2.0);
    if (spin) check("spin", *spin, 0.0, 500.0);
  }
};

/// The names of the actions, as for action_named().
inline constexpr std::array<std::string_view, 8> kActionNames{
    "linear_acceleration", "circular_acceleration", "swing", "hop", "throw", "side_throw", "catch", "stop"};

namespace detail {

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

}  // namespace detail

/// Where the tips start a figure whose name is one of kActionNames, for a string of the given length: the
/// authors' poses, scaled with the string; left over right [m].
inline TipColumn<double> home_pose(std::string_view action, double string_length) {
  const double s = string_length / kAuthorsStringLength;
  if (action == "linear_acceleration")
    return detail::tips_column(0.55, 0.1 * s, 1.25 + 0.2 * s, -0.1 * s, 1.25 - 0.2 * s);
  if (action == "circular_acceleration") return detail::tips_column(0.55, 0.21 * s, 1.25, -0.28 * s, 1.25);
  if (action == "throw" || action == "side_throw")
    return detail::tips_column(0.55, 0.25 * s, 1.25, -0.25 * s, 1.25);
  if (action == "catch") return detail::tips_column(0.55, 0.65 * s, 1.25, -0.65 * s, 1.25);
  return detail::tips_column(0.55, 0.3 * s, 1.25, -0.3 * s, 1.25);
}

/// A diabolo that hangs at rest below the tips.
inline State<double> hanging_state(const TipColumn<double>& tips, double string_length, double spin) {
  State<double> state;
  state.position = lowest_point(tips.head<3>(), tips.tail<3>(), string_length);
  state.spin = spin;
  state.string_state = StringState::kOnString;
  return state;
}

/// The authors' linear acceleration: the right hand pulls up while the left one sinks, and back.
inline StickSpline<double> linear_acceleration_seed(const TipColumn<double>& home, double size, double pace) {
  return detail::through(
      home, {0.25, 0.5, 0.9, 1.2},
      {detail::tips_column(0.0, -0.05, -0.15, 0.05, 0.2), detail::tips_column(0.0, 0.0, -0.3, 0.0, 0.4),
       detail::tips_column(0.0, -0.05, -0.15, 0.05, 0.2), TipColumn<double>::Zero()},
      size, pace);
}

/// The authors' circular acceleration: the hands follow each other around, the diabolo runs below them.
inline StickSpline<double> circular_acceleration_seed(const TipColumn<double>& home, double size,
                                                      double pace) {
  return detail::through(
      home, {0.35, 0.65, 0.95, 1.25, 1.55, 1.85},
      {detail::tips_column(0.0, -0.061, 0.1801, -0.042, 0.2),
       detail::tips_column(0.0, 0.0592, 0.382, -0.24, 0.3),
       detail::tips_column(0.0, 0.2619, 0.344, -0.41, 0.2),
       detail::tips_column(0.0, 0.31, 0.15914, -0.371, 0.0),
       detail::tips_column(0.0, 0.141, 0.03543, -0.163, -0.076), TipColumn<double>::Zero()},
      size, pace);
}

/// The authors' vertical throw: both hands part in three strides, level with each other.
inline StickSpline<double> authors_throw_seed(const TipColumn<double>& home) {
  return detail::through(home, {0.4, 0.8, 0.92},
                         detail::together({{0.0, 0.0, 0.2}, {0.0, 0.0, 0.65}, {0.0, 0.0, 0.731}}), 1.0, 1.0);
}

/// The authors' horizontal impulse, which prepares others: both hands sway from side to side.
inline StickSpline<double> horizontal_impulse_seed(const TipColumn<double>& home) {
  return detail::through(
      home, {0.9, 1.4, 2.0, 2.8, 3.5},
      detail::together(
          {{0.23, 0.0, 0.0}, {0.12, 0.0, 0.0}, {-0.12, 0.0, 0.0}, {0.23, 0.0, 0.0}, {0.0, 0.0, 0.0}}),
      1.0, 1.0);
}

/// The authors' goals of a round of circular acceleration, base and four more states, scaled with the string
/// about the middle of the tips.
inline std::vector<Waypoint> circle_goals(double string_length) {
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

namespace detail {

/// The hands sink, part quickly while they rise, and give way at the end, lest the string catch the diabolo
/// as it leaves; faster for higher throws, leaning to where it shall come down. (Found by GradientSearch from
/// a coarser one, as the throw of 0.75 m; its left and right halves averaged.)
inline StickSpline<double> throw_seed(const TipColumn<double>& home, double string_length,
                                      const ActionOptions& options, double sideways) {
  const double size = options.size * string_length / 1.45;
  const double pace = options.pace * std::pow(std::clamp(options.height, 0.1, 2.0) / 0.75, 0.15);
  const double lean = 0.15 * sideways, home_gap = 0.5 * (home[1] - home[4]) * 1.45 / string_length;
  return through(home, {0.42, 0.56, 0.69, 0.87},
                 together({{-lean, -0.175, 0.212 - home_gap},
                           {lean, 0.06, 0.58 - home_gap},
                           {lean, 0.23, 0.706 - home_gap},
                           {lean, 0.155, 0.583 - home_gap}}),
                 size, pace);
}

}  // namespace detail

/// The action of the given name, from the pose where the tips rest and the diabolo's state then, for a string
/// of that length. Throws std::invalid_argument where there is none of that name, or an option is out of its
/// range. For "catch" see catch_action().
inline Action action_named(std::string_view name, const TipColumn<double>& tips, const State<double>& start,
                           double string_length, const ActionOptions& options) {
  options.validate();
  const double s = options.size * string_length / kAuthorsStringLength;
  const Vector3<double> middle = 0.5 * (tips.head<3>() + tips.tail<3>());
  const Vector3<double> rest = lowest_point(tips.head<3>(), tips.tail<3>(), string_length);
  Action action;
  action.name = name;
  action.freedom.last_point = false;
  action.goals.final_state = Waypoint{rest, Vector3<double>::Zero(), 1.0, 0.3, 0.0};
  const auto spin_up = [&] {
    if (options.spin)
      action.goals.spin = Target{start.spin + (start.spin < 0.0 ? -*options.spin : *options.spin), 0.02};
    action.goals.taut = 0.3;
  };
  if (name == "linear_acceleration") {
    action.seed = linear_acceleration_seed(tips, s, options.pace);
    spin_up();
  } else if (name == "circular_acceleration") {
    action.seed = circular_acceleration_seed(tips, s, options.pace);
    action.goals.waypoints = circle_goals(string_length);
    spin_up();
  } else if (name == "swing") {
    const double lean = 0.3 * options.sideways;
    action.seed = detail::through(
        tips, {0.35, 0.8, 1.3, 1.7},
        detail::together(
            {{0.5 * lean, 0.0, 0.0}, {lean, 0.0, 0.0}, {-0.3 * lean, 0.0, 0.0}, {0.0, 0.0, 0.0}}),
        options.size, options.pace);
    const Vector3<double> side = rest + Vector3<double>(0.0, options.sideways, 0.0);
    action.goals.waypoints = {
        Waypoint{{side.x(), side.y(), rest.z() + 0.3 * options.sideways * options.sideways},
                 Vector3<double>::Zero(),
                 1.0,
                 0.0,
                 0.0}};
    action.goals.taut = 0.3;
  } else if (name == "hop") {
    action.seed = detail::through(
        tips, {0.25, 0.5, 0.75, 1.1},
        detail::together({{0.0, -0.08, 0.0}, {0.0, 0.12, 0.02}, {0.0, -0.05, 0.0}, {0.0, 0.0, 0.0}}), s,
        options.pace);
    action.goals.waypoints = {
        Waypoint{rest + Vector3<double>(0.0, 0.0, options.height), Vector3<double>::Zero(), 1.0, 0.0, 0.0}};
  } else if (name == "throw" || name == "side_throw") {
    const double sideways = name == "throw" ? 0.0 : options.sideways;
    action.seed = detail::throw_seed(tips, string_length, options, sideways);
    action.freedom.last_point = true;
    action.goals.final_state.reset();
    action.goals.apex = Target{options.height};
    action.goals.landing = Landing{middle + Vector3<double>(0.0, sideways, 0.0)};
  } else if (name == "stop") {
    action.seed = detail::through(
        tips, {0.3, 0.6, 0.9, 1.2},
        detail::together({{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}), 1.0,
        options.pace);
    action.goals.final_state->velocity_weight = 1.0;
  } else {
    std::string names;
    for (const std::string_view known : kActionNames) names.append(names.empty() ? "" : ", ").append(known);
    throw std::invalid_argument("action '" + std::string(name) + "': expected one of " + names);
  }
  return action;
}

}  // namespace diabolo
