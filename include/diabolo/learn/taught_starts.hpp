// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/learn/arena_options.hpp"
#include "diabolo/learn/planned_hands.hpp"
#include "diabolo/plan/plan_action.hpp"

namespace diabolo {

// What a reward alone does not lead to is learnt from its end: episodes that begin in the middle of a play
// which the player has planned (Salimans and Chen 2018, "Learning Montezuma's Revenge from a single
// demonstration").

/// A task, and the player's action that does what it wants: which number of the goal is what the action aims
/// at, if any, and in which part of the task it begins.
struct Lesson {
  std::string_view task, action;
  std::optional<std::size_t> spin{}, height{}, sideways{};
  int stage = 0, flights = 0;
};

inline constexpr std::array kLessons{
    Lesson{.task = "Hop", .action = kThrowAndCatch, .height = 0},
    Lesson{.task = "Throw", .action = kThrowAndCatch, .height = 0},
    Lesson{.task = "ThrowAndCatch", .action = kThrowAndCatch, .height = 0, .sideways = 1},
    Lesson{.task = "Pass", .action = "side_throw", .sideways = 0, .flights = 1},
    Lesson{.task = "Routine", .action = kThrowAndCatch, .spin = 0, .height = 1, .stage = 1}};

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

/// The flight of a planned play: its instants, from the first one to the catch, or to where it comes down
/// through the height of the box's centre; its apex and that place, from that centre [m].
struct LessonFlight {
  std::size_t end = 0;
  double apex = 0.0, sideways = 0.0;
};

/// None where nothing flies, or where it does not end so. `shift` [m] moves the play into the box.
inline std::optional<LessonFlight> flight_of(const PlannedPlay& planned, const Vector3<double>& shift,
                                             const Vector3<double>& centre) {
  const std::vector<PlayInstant<double>>& instants = planned.play.instants;
  const bool ends_in_catch = planned.action == kThrowAndCatch;
  LessonFlight flight{.apex = -std::numeric_limits<double>::infinity()};
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const State<double>& state = instants[i].state;
    if (state.string_state != StringState::kFlying) continue;
    const Vector3<double> place = state.position + shift - centre;
    if (!ends_in_catch && place.z() < 0.0 && state.velocity.z() < 0.0) break;
    flight.apex = std::max(flight.apex, place.z());
    last = i;
  }
  if (!last || *last + 1 == instants.size()) return {};
  flight.end = *last + 1;
  flight.sideways = (instants[flight.end].state.position + shift - centre).y();
  return flight;
}

/// Moments of a planned play, `every` seconds [s] and until its flight is over, moved to the middle of the
/// hands' box. Skips moments in which the hands are not within their limits, or farther apart than
/// `farthest` [m]. The goal of each is what the play reaches. None where it is not caught, or does not come
/// down.
inline std::vector<EpisodeStart> starts_along(const PlannedPlay& planned, const Lesson& lesson,
                                              const HandLimits& limits, double every, double farthest) {
  const std::vector<PlayInstant<double>>& instants = planned.play.instants;
  if (instants.empty()) return {};
  const Vector3<double> shift = shift_to(limits.centre, planned);
  const std::optional<LessonFlight> flight = flight_of(planned, shift, limits.centre);
  if (!flight) return {};
  Goal goal{};
  if (lesson.spin) goal[*lesson.spin] = instants.front().state.spin;
  if (lesson.height) goal[*lesson.height] = flight->apex;
  if (lesson.sideways) goal[*lesson.sideways] = flight->sideways;

  std::vector<EpisodeStart> starts;
  double next = instants.front().time;
  for (std::size_t i = 0; i < flight->end; ++i) {
    if (instants[i].time < next) continue;
    next += every;
    const Tips<double>& tips = instants[i].tips;
    EpisodeStart start{instants[i].state,
                       {{tips.left + shift, tips.right + shift}, {tips.left_velocity, tips.right_velocity}},
                       goal,
                       lesson.stage,
                       lesson.flights,
                       std::string(lesson.task)};
    start.state.position += shift;
    if (limits.allow(start.hands) && (tips.left - tips.right).norm() <= farthest) starts.push_back(start);
  }
  return starts;
}

namespace learn_detail {

inline void expect_some(const std::vector<EpisodeStart>& starts) {
  if (starts.empty())
    throw std::invalid_argument("taught starts: no play was found within the limits of the hands");
}

}  // namespace learn_detail

/// Plans plays with goals of a task's ranges, each with one of `models`, and shows each of them and its goal
/// to `visit`. The hands keep to the shortest of the models' strings, whose length less what the limits want
/// is the third that `visit` is told [m]. Throws std::invalid_argument about bad input, and Cancelled.
template <class Visit, template <class> class... Effects>
void plan_lesson(std::string_view task, const std::vector<Predictor<double, Effects...>>& models,
                 const LessonOptions& options, const Visit& visit) {
  const TaskInfo& info = *task_named(task).info;
  const Lesson& lesson = lesson_for(task);
  ActionRequest wanted{.action = std::string(lesson.action)};
  options.limits.validate();
  if (models.empty()) throw std::invalid_argument("models: none; expected at least one");
  if (options.plays < 1 || options.plays > LessonOptions::kMostPlays)
    throw std::invalid_argument("plays: " + std::to_string(options.plays) + "; expected 1 to " +
                                std::to_string(LessonOptions::kMostPlays));
  wanted.search.cancelled = options.cancelled;
  double farthest = std::numeric_limits<double>::infinity();
  for (const auto& model : models)
    farthest = std::min(farthest, model.parameters().string_length - options.limits.string_margin);
  for (int play = 0; play < options.plays; ++play) {
    Draw draw(options.seed, static_cast<std::uint64_t>(play));
    Goal goal{};
    const auto drawn = [&](std::size_t number) {
      return goal[number] = draw.uniform(info.goal[number].low, info.goal[number].high);
    };
    wanted.spin = lesson.spin ? drawn(*lesson.spin) : draw.uniform(info.least_spin, info.most_spin);
    if (lesson.height) wanted.height = drawn(*lesson.height);
    if (lesson.sideways) wanted.sideways = drawn(*lesson.sideways);
    const std::vector model{models[draw.index(models.size())]};
    const double length = model.front().parameters().string_length;
    wanted.limits = tip_limits(options.limits, home_pose(wanted.figure(), length));
    visit(plan_action(wanted, model), goal, farthest);
  }
}

/// Starts for episodes of a task along such plays, 20 ms apart; the goal of each is what its play reaches.
/// Throws as plan_lesson() does.
template <template <class> class... Effects>
std::vector<EpisodeStart> taught_starts(std::string_view task,
                                        const std::vector<Predictor<double, Effects...>>& models,
                                        const LessonOptions& options) {
  constexpr double kEvery = 0.02;  // [s]
  std::vector<EpisodeStart> starts;
  plan_lesson(task, models, options, [&](const PlannedPlay& planned, const Goal&, double farthest) {
    const std::vector<EpisodeStart> along =
        starts_along(planned, lesson_for(task), options.limits, kEvery, farthest);
    starts.insert(starts.end(), along.begin(), along.end());
  });
  learn_detail::expect_some(starts);
  return starts;
}

}  // namespace diabolo
