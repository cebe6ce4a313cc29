// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "diabolo/learn/draw.hpp"
#include "diabolo/learn/hands.hpp"
#include "diabolo/state.hpp"

namespace diabolo {

/// Most numbers of a goal.
inline constexpr std::size_t kMostGoalNumbers = 2;
using Goal = std::array<double, kMostGoalNumbers>;

/// One number of a task's goal: drawn uniformly from its range in each episode. An empty name: not used.
struct GoalInfo {
  std::string_view name, unit;
  double low = 0.0, high = 0.0;
  std::string_view meaning;
  double seen_over = 1.0;  ///< what it is divided by where an agent sees it
};

/// An agent sees spins over this [rad/s], so that they are about one.
inline constexpr double kSpinSeenOver = 100.0;

/// What a task is, for people and programs.
struct TaskInfo {
  std::string_view name, meaning, reward;  ///< the reward as a formula
  double seconds;                          ///< an episode is cut off then
  std::array<GoalInfo, kMostGoalNumbers> goal{};
  double least_spin = 60.0, most_spin = 120.0;  ///< of the diabolo at first [rad/s]
  bool axle = false;  ///< its axle is free (draw_free_axle), and seen after the usual numbers
};

/// What an episode remembers beyond the state.
struct Memory {
  std::optional<double> progress{};  ///< the last potential of a shaped reward
  double apex = 0.0;                 ///< highest place of the last flight, above the box's centre [m]
  double aloft = 0.0, caught = 0.0;  ///< time since it left the string, and since it was caught [s]
  double level = 0.0;  ///< how long the axle has been level by now, in a task that levels it [s]
  int flights = 0;     ///< that ended in a catch
  int stage = 0;       ///< of a task that has several
  bool flying = false;
};

/// What an episode begins with, where a task changes it.
struct Beginning {
  State<double>& state;
  const Vector3<double>& centre;  ///< of the hands' box [m]
  double gravity;                 ///< [m/s^2]
  Draw& draw;
};

/// One control period of an episode, as a task looks at it.
struct Moment {
  const State<double>&before, &after;  ///< at its begin and at its end
  const Hands& hands;                  ///< at its end
  const Vector3<double>& centre;       ///< of the hands' box [m]
  const Vector3<double>& rest;         ///< where the diabolo hangs at first [m]
  double gravity, period;              ///< [m/s^2], [s]
  const Goal& goal;
};

/// What a period was worth, and whether the episode ends with it by a success.
struct Worth {
  double reward = 0.0;
  bool achieved = false;
};

}  // namespace diabolo
