// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/learn/arena_options.hpp"
#include "diabolo/plan/plan_action.hpp"

namespace diabolo {

// What a reward alone does not lead to is learnt from its end: episodes that begin in the middle of a play
// which the player has planned (Salimans and Chen 2018, "Learning Montezuma's Revenge from a single
// demonstration").

/// A task, and the player's action that does what it wants.
struct Lesson {
  std::string_view task, action;
};

inline constexpr std::array kLessons{Lesson{"Throw", kThrowAndCatch},
                                     Lesson{"ThrowAndCatch", kThrowAndCatch}};

/// The lesson for a task. Throws std::invalid_argument where there is none.
inline const Lesson& lesson_for(std::string_view task) {
  std::string known;
  for (const Lesson& lesson : kLessons) {
    if (lesson.task == task) return lesson;
    known += (known.empty() ? "" : ", ") + std::string(lesson.task);
  }
  throw std::invalid_argument("task: found " + shown(task) + ", which the player does not teach; expected " +
                              known);
}

/// How many plays are planned, and for what hands.
struct LessonOptions {
  static constexpr int kMostPlays = 10000;

  int plays = 48;
  std::uint64_t seed = 0;  ///< of their goals, spins and models
  HandLimits limits{};
  std::function<bool()> cancelled{};  ///< true ends the planning with Cancelled
};

/// The same limits for the player, whose play begins at `home`.
inline TipLimits tip_limits(const HandLimits& limits, const TipColumn<double>& home) {
  const Vector3<double> middle = 0.5 * (home.head<3>() + home.tail<3>());
  return {.speed = limits.speed,
          .acceleration = limits.acceleration,
          .string_margin = limits.string_margin,
          .least_gap = limits.gap,
          .lowest = middle - limits.half,
          .highest = middle + limits.half};
}

/// Moments of a planned play, `every` seconds [s] and until its flight is caught, moved to the middle of the
/// hands' box. Skips moments in which the hands are not within their limits, or farther apart than
/// `farthest` [m]. The goal of each is what the play reaches: its apex, and where it is caught. None where it
/// is not caught.
inline std::vector<EpisodeStart> starts_along(const PlannedPlay& planned, const HandLimits& limits,
                                              double every, double farthest) {
  const std::vector<PlayInstant<double>>& instants = planned.play.instants;
  const auto flies = [](const PlayInstant<double>& instant) {
    return instant.state.string_state == StringState::kFlying;
  };
  const auto last = std::find_if(instants.rbegin(), instants.rend(), flies);
  if (last == instants.rend() || last == instants.rbegin()) return {};
  const auto caught = last.base();
  const Vector3<double> shift =
      limits.centre - 0.5 * (instants.front().tips.left + instants.front().tips.right);
  Goal goal{-std::numeric_limits<double>::infinity(),
            caught->state.position.y() + shift.y() - limits.centre.y()};
  for (auto instant = instants.begin(); instant != caught; ++instant)
    if (flies(*instant))
      goal[0] = std::max(goal[0], instant->state.position.z() + shift.z() - limits.centre.z());

  std::vector<EpisodeStart> starts;
  double next = instants.front().time;
  for (auto instant = instants.begin(); instant != caught; ++instant) {
    if (instant->time < next) continue;
    next += every;
    const Tips<double>& tips = instant->tips;
    EpisodeStart start{instant->state,
                       {{tips.left + shift, tips.right + shift}, {tips.left_velocity, tips.right_velocity}},
                       goal};
    start.state.position += shift;
    if (limits.allow(start.hands) && (tips.left - tips.right).norm() <= farthest) starts.push_back(start);
  }
  return starts;
}

/// Starts for episodes of a task along plays with goals of its ranges, each planned with one of `models`. The
/// hands keep to the shortest of their strings.
/// Throws std::invalid_argument about bad input, and Cancelled.
template <template <class> class... Effects>
std::vector<EpisodeStart> taught_starts(std::string_view task,
                                        const std::vector<Predictor<double, Effects...>>& models,
                                        const LessonOptions& options) {
  constexpr double kEvery = 0.02;  // [s]
  const TaskInfo& info = *task_named(task).info;
  ActionRequest wanted{.action = std::string(lesson_for(task).action)};
  options.limits.validate();
  if (models.empty()) throw std::invalid_argument("models: none; expected at least one");
  if (options.plays < 1 || options.plays > LessonOptions::kMostPlays)
    throw std::invalid_argument("plays: " + std::to_string(options.plays) + "; expected 1 to " +
                                std::to_string(LessonOptions::kMostPlays));
  wanted.search.cancelled = options.cancelled;
  double farthest = std::numeric_limits<double>::infinity();
  for (const auto& model : models)
    farthest = std::min(farthest, model.parameters().string_length - options.limits.string_margin);
  std::vector<EpisodeStart> starts;
  for (int play = 0; play < options.plays; ++play) {
    Draw draw(options.seed, static_cast<std::uint64_t>(play));
    wanted.spin = draw.uniform(info.least_spin, info.most_spin);
    wanted.height = draw.uniform(info.goal[0].low, info.goal[0].high);
    if (!info.goal[1].name.empty()) wanted.sideways = draw.uniform(info.goal[1].low, info.goal[1].high);
    const std::vector model{models[draw.index(models.size())]};
    const double length = model.front().parameters().string_length;
    wanted.limits = tip_limits(options.limits, home_pose(wanted.figure(), length));
    const std::vector<EpisodeStart> along =
        starts_along(plan_action(wanted, model), options.limits, kEvery, farthest);
    starts.insert(starts.end(), along.begin(), along.end());
  }
  if (starts.empty())
    throw std::invalid_argument("taught starts: no play was found within the limits of the hands");
  return starts;
}

}  // namespace diabolo
