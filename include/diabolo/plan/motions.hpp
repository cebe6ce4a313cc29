// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/evaluate/baseline.hpp"
#include "diabolo/plan/authors_motions.hpp"
#include "diabolo/plan/goals.hpp"
#include "diabolo/plan/motion_unknowns.hpp"
#include "diabolo/state.hpp"
#include "diabolo/string/hanging.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A figure of play: a seed motion of the tips, what the solver may change of it, and what it shall lead to.
/// It starts and ends with the tips at rest.
struct Action {
  std::string name;
  StickSpline<double> seed;
  Freedom freedom{};
  Goals goals{};
};

namespace plan_detail {

inline void check_option(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw std::invalid_argument(std::string("action, ") + name + ": " + shown(value) + "; must be within " +
                              shown(low) + " and " + shown(high));
}

}  // namespace plan_detail

/// What can be asked of an action.
struct ActionOptions {
  double size = 1.0;                  ///< of the hands' motion, as a share of the usual one
  double pace = 1.0;                  ///< its speed, likewise
  double height = 0.5;                ///< of hops over the start, of throws above the tips [m]
  double sideways = 0.3;              ///< of swings and throws to the side, to the left [m]
  std::optional<double> spin_gain{};  ///< to be gained in a cycle of acceleration [rad/s]

  /// Throws std::invalid_argument where one is out of its range.
  void validate() const {
    plan_detail::check_option("size", size, 0.1, 3.0);
    plan_detail::check_option("pace", pace, 0.2, 5.0);
    plan_detail::check_option("height", height, 0.01, 5.0);
    plan_detail::check_option("sideways", sideways, -2.0, 2.0);
    if (spin_gain) plan_detail::check_option("spin_gain", *spin_gain, 0.0, 500.0);
  }
};

/// The names of the actions, as for action_named(); for the catch of a throw see catch_action().
inline constexpr std::array<std::string_view, 9> kActionNames{
    "linear_acceleration", "wind_up", "one_turn_low", "circular_acceleration", "swing", "hop", "throw",
    "side_throw",          "stop"};

/// Where the tips start a figure whose name is one of kActionNames, for a string of the given length: the
/// authors' poses, scaled with the string, and close together where the string has a turn; left over right
/// [m].
inline TipColumn<double> home_pose(std::string_view action, double string_length) {
  const double s = string_length / kAuthorsStringLength;
  if (action == "linear_acceleration")
    return plan_detail::tips_column(0.55, 0.265 * s, 1.25 + 0.076 * s, -0.265 * s, 1.25 - 0.076 * s);
  if (action == "wind_up") return plan_detail::tips_column(0.55, 0.11 * s, 1.25, -0.11 * s, 1.25);
  if (action == "one_turn_low") return plan_detail::tips_column(0.55, 0.11 * s, 1.0, -0.11 * s, 1.0);
  if (action == "circular_acceleration")
    return plan_detail::tips_column(0.55, 0.21 * s, 1.25, -0.28 * s, 1.25);
  if (action == "throw" || action == "side_throw")
    return plan_detail::tips_column(0.55, 0.25 * s, 1.25, -0.25 * s, 1.25);
  return plan_detail::tips_column(0.55, 0.3 * s, 1.25, -0.3 * s, 1.25);
}

/// A diabolo that hangs at rest below the tips, left over right [m].
inline State<double> hanging_state(const TipColumn<double>& tips, double string_length, double spin) {
  return hanging_state(Vector3<double>(tips.head<3>()), Vector3<double>(tips.tail<3>()), string_length, spin);
}

namespace plan_detail {

/// Long pulls of the right hand against short returns. (Found by RandomWalk and GradientSearch with a string
/// friction of 0.25: at 60 rad/s a cycle gains 8 rad/s.)
inline StickSpline<double> linear_acceleration_seed(const TipColumn<double>& home, double size, double pace) {
  return through(
      home, {0.241, 0.457, 0.574, 0.736, 0.964, 1.146},
      {tips_column(0.0, -0.172, -0.218, 0.08, 0.155), tips_column(0.0, -0.176, -0.332, 0.101, 0.326),
       tips_column(0.0, -0.155, -0.272, -0.163, 0.535), tips_column(0.0, 0.041, -0.083, -0.188, 0.532),
       tips_column(0.0, 0.161, 0.247, 0.073, 0.062), TipColumn<double>::Zero()},
      size, pace);
}

/// For a string with one turn (Parameters::wraps): the right hand pulls, which the left one follows, and both
/// go back while the diabolo all but falls, so that the string slips back without pull. (Found by a random
/// walk with string frictions of 0.2 to 0.3: at 60 rad/s a cycle gains 8 rad/s.)
inline StickSpline<double> wind_up_seed(const TipColumn<double>& home, double size, double pace) {
  return through(home, {0.134, 0.218, 0.371},
                 {tips_column(0.0, 0.002, -0.143, -0.065, 0.099),
                  tips_column(0.0, -0.051, -0.142, -0.047, 0.211), TipColumn<double>::Zero()},
                 size, pace);
}

/// The same with small strokes of hands that are held low. (Found likewise.)
inline StickSpline<double> one_turn_low_seed(const TipColumn<double>& home, double size, double pace) {
  return through(home, {0.116, 0.212, 0.346},
                 {tips_column(0.0, -0.015, -0.046, 0.043, -0.028),
                  tips_column(0.0, -0.08, -0.08, -0.016, 0.1), TipColumn<double>::Zero()},
                 size, pace);
}

/// The hands go around, and the diabolo up on the left, over to the right and down. (Found likewise: repeated
/// without looking, it keeps its circle and gains 2 rad/s a round.)
inline StickSpline<double> circular_acceleration_seed(const TipColumn<double>& home, double size,
                                                      double pace) {
  return through(
      home, {0.161, 0.445, 0.576, 1.325, 1.55, 1.893},
      {tips_column(0.0, -0.0243, 0.1578, -0.012, 0.2493), tips_column(0.0, 0.0361, 0.3838, -0.2466, 0.1779),
       tips_column(0.0, 0.1431, 0.277, -0.4334, 0.1898), tips_column(0.0, 0.2928, 0.2459, -0.2918, -0.0578),
       tips_column(0.0, 0.1391, 0.0536, -0.0783, -0.0711), TipColumn<double>::Zero()},
      size, pace);
}

/// States of that circle on its way, relative to the middle of the tips at rest, and its last one.
inline void add_circle(const Vector3<double>& middle, const Vector3<double>& rest, double scale,
                       Goals& goals) {
  for (const auto& [y, z] : {std::array{0.24, -0.25}, {-0.1, -0.04}, {-0.33, -0.36}})
    goals.waypoints.push_back(
        Waypoint{middle + Vector3<double>(0.0, y, z) * scale, Vector3<double>::Zero(), 0.3});
  const double speed = 1.1 * std::sqrt(scale);
  goals.final_state = Waypoint{rest, Vector3<double>(0.0, speed, 0.0), 1.0, 0.3, 0.3};
  goals.tolerances.position = 0.08 * scale;
  goals.tolerances.taut = 0.6;
}

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

}  // namespace plan_detail

/// The action of the given name, from the pose where the tips rest and the diabolo's state then, for a string
/// of that length. Throws std::invalid_argument where there is none of that name, or an option or the length
/// is out of its range.
inline Action action_named(std::string_view name, const TipColumn<double>& tips, const State<double>& start,
                           double string_length, const ActionOptions& wanted) {
  wanted.validate();
  plan_detail::check_option("string_length", string_length, 0.05, 20.0);  // as of Parameters
  ActionOptions options = wanted;
  options.pace /= std::sqrt(string_length / 1.45);  // longer pendulums are slower
  const double s = options.size * string_length / kAuthorsStringLength;
  const Vector3<double> middle = 0.5 * (tips.head<3>() + tips.tail<3>());
  const Vector3<double> rest = lowest_point(tips.head<3>(), tips.tail<3>(), string_length);
  Action action;
  action.name = name;
  action.freedom.last_point = false;
  action.goals.final_state = Waypoint{rest, Vector3<double>::Zero(), 1.0, 0.3, 0.0};
  const auto spin_up = [&] {
    if (options.spin_gain)
      action.goals.spin =
          Target{start.spin + (start.spin < 0.0 ? -*options.spin_gain : *options.spin_gain), 0.02};
    action.goals.taut = 0.1;
  };
  if (name == "linear_acceleration") {
    action.seed =
        plan_detail::linear_acceleration_seed(tips, options.size * string_length / 1.45, options.pace);
    action.goals.tolerances.taut = 0.6;
    spin_up();
  } else if (name == "wind_up") {
    action.seed = plan_detail::wind_up_seed(tips, options.size * string_length / 1.45, options.pace);
    action.goals.tolerances.taut = 0.6;
    spin_up();
  } else if (name == "one_turn_low") {
    action.seed = plan_detail::one_turn_low_seed(tips, options.size * string_length / 1.45, options.pace);
    action.goals.tolerances.taut = 0.6;  // the diabolo hops
    spin_up();
  } else if (name == "circular_acceleration") {
    action.seed =
        plan_detail::circular_acceleration_seed(tips, options.size * string_length / 1.45, options.pace);
    plan_detail::add_circle(middle, rest, options.size * string_length / 1.45, action.goals);
    spin_up();
  } else if (name == "swing") {
    const double lean = 0.3 * options.sideways;
    action.seed = plan_detail::through(
        tips, {0.35, 0.8, 1.3, 1.7},
        plan_detail::together(
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
    action.seed = plan_detail::through(
        tips, {0.25, 0.5, 0.75, 1.1},
        plan_detail::together({{0.0, -0.08, 0.0}, {0.0, 0.12, 0.02}, {0.0, -0.05, 0.0}, {0.0, 0.0, 0.0}}), s,
        options.pace);
    action.goals.waypoints = {
        Waypoint{rest + Vector3<double>(0.0, 0.0, options.height), Vector3<double>::Zero(), 1.0, 0.0, 0.0}};
  } else if (name == "throw" || name == "side_throw") {
    const double sideways = name == "throw" ? 0.0 : options.sideways;
    action.seed = plan_detail::throw_seed(tips, string_length, options, sideways);
    action.freedom.last_point = true;
    action.goals.final_state.reset();
    action.goals.apex = Target{options.height};
    action.goals.landing = Landing{middle + Vector3<double>(0.0, sideways, 0.0)};
  } else if (name == "stop") {
    action.seed = plan_detail::through(
        tips, {0.3, 0.6, 0.9, 1.2},
        plan_detail::together({{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}), 1.0,
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
