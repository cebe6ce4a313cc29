// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/learn/all_tasks.hpp"
#include "diabolo/learn/episode.hpp"

namespace diabolo {

/// A slice of an observation.
struct ObservationInfo {
  std::string_view name, unit;
  std::size_t size;
  std::string_view meaning;
};

/// What an agent sees, in this order. With a camera, the diabolo is where the camera saw it, and the string
/// is taut where the sticks feel it, else loose.
inline constexpr std::array kObservations{
    ObservationInfo{"diabolo", "m", 3, "position from the middle of the tips"},
    ObservationInfo{"velocity", "m/s", 3, "of the diabolo"},
    ObservationInfo{"spin", "100 rad/s", 1, "of the diabolo"},
    ObservationInfo{"string", "1", 3, "1 where it is on the string; loose; flying"},
    ObservationInfo{"left", "m", 3, "left tip from the middle of the tips' box"},
    ObservationInfo{"right", "m", 3, "right tip from the middle of the tips' box"},
    ObservationInfo{"left_velocity", "m/s", 3, "of the left tip"},
    ObservationInfo{"right_velocity", "m/s", 3, "of the right tip"},
    ObservationInfo{"goal", "of the goal", kMostGoalNumbers, "0 where the task has none"},
    ObservationInfo{"flights", "1", 1, "that ended in a catch"},
    ObservationInfo{
        "left_force", "weights", 3,
        "of the string on the left tip, in weights of the diabolo, the mean over the period, at most 20"},
    ObservationInfo{"right_force", "weights", 3, "of the string on the right tip, as well"},
    ObservationInfo{"stage", "1", 1, "of a task that has several"},
};

/// What an agent sees after these where one of its tasks says so.
inline constexpr std::array kAxleObservations{
    ObservationInfo{"axle", "1", 3, "direction of the axle, forward"},
    ObservationInfo{"axle_rate", "1/s", 3, "of that direction"},
};

/// What it sees last where it corrects a plan (HandPlan). The plan's diabolo is where it would be by now.
inline constexpr std::array kPlanObservations{
    ObservationInfo{"off_plan", "m", 3, "diabolo, from where the plan has it"},
    ObservationInfo{"off_velocity", "m/s", 3, "of the diabolo, less the plan's"},
    ObservationInfo{"off_left", "m", 3, "left tip, from where the plan has it"},
    ObservationInfo{"off_right", "m", 3, "right tip, from where the plan has it"},
    ObservationInfo{"off_left_velocity", "m/s", 3, "of the left tip, less the plan's"},
    ObservationInfo{"off_right_velocity", "m/s", 3, "of the right tip, less the plan's"},
    ObservationInfo{"plan_left", "of the largest", 3,
                    "acceleration of the left tip that the plan has in the coming period"},
    ObservationInfo{"plan_right", "of the largest", 3, "of the right tip, as well"},
    ObservationInfo{"plan_time", "s", 1, "until the plan ends"},
};

namespace learn_detail {

constexpr std::size_t size_of(const auto& infos) {
  std::size_t sum = 0;
  for (const ObservationInfo& info : infos) sum += info.size;
  return sum;
}

}  // namespace learn_detail

inline constexpr std::size_t kObservationSize = learn_detail::size_of(kObservations);  ///< of the usual ones
inline constexpr std::size_t kAxleSize = learn_detail::size_of(kAxleObservations);
inline constexpr std::size_t kPlanSize = learn_detail::size_of(kPlanObservations);

/// Which numbers an agent sees beside the usual ones.
struct SeenToo {
  bool axle = false;      ///< where one of its tasks has a free axle
  std::size_t tasks = 0;  ///< a number for each of several tasks, 1 where it is played
  bool plan = false;      ///< where it corrects one
};

/// What an agent of these tasks, all known, sees beside the usual numbers.
inline SeenToo seen_too(const std::vector<std::string>& tasks, bool plan) {
  const bool axle = std::ranges::any_of(tasks, [](const auto& name) { return task_named(name).info->axle; });
  return {axle, tasks.size() > 1 ? tasks.size() : 0, plan};
}

/// How many numbers an agent sees.
constexpr std::size_t observation_size(const SeenToo& too) {
  return kObservationSize + (too.axle ? kAxleSize : 0) + too.tasks + (too.plan ? kPlanSize : 0);
}

/// Largest number of an observation.
inline constexpr double kMostObserved = 1e3;

/// Forces of the string on the tips, in weights of the diabolo, no larger than 20: what it does to the
/// diabolo [m/s^2], along its two sides. Straight sides cannot be distinguished, and get little.
inline Hands::Pair tip_forces(const State<double>& state, const Hands& hands, const Vector3<double>& pulled) {
  constexpr double kStraight = 1e-3;  // of 1 - cos^2 of the angle between the sides
  constexpr double kMost = 20.0;      // what a sensor shows [weights]
  Hands::Pair sides;
  for (std::size_t side = 0; side < 2; ++side)
    sides[side] = (state.position - hands.position[side]).normalized();
  const double cosine = sides[0].dot(sides[1]), determinant = 1.0 - cosine * cosine + kStraight;
  const Vector3<double> pull = -pulled / kStandardGravity;
  const double left = sides[0].dot(pull), right = sides[1].dot(pull);
  return {std::clamp((left - cosine * right) / determinant, 0.0, kMost) * sides[0],
          std::clamp((right - cosine * left) / determinant, 0.0, kMost) * sides[1]};
}

/// Writes observation_size(too) numbers, none beyond kMostObserved. With `camera`, what it saw.
inline void observe(const Episode& episode, const TaskInfo& task, const SeenToo& too,
                    const Vector3<double>& centre, bool camera, float* to) {
  const auto put = [&to](double x) {
    *to++ = static_cast<float>(std::clamp(x, -kMostObserved, kMostObserved));
  };
  const auto put3 = [&](const Vector3<double>& v) {
    for (const double x : v) put(x);
  };
  const State<double>& state = episode.state;
  const auto& [left, right] = episode.hands.position;
  const Hands::Pair forces = tip_forces(state, episode.hands, episode.pull);
  const Seen seen = camera ? episode.sight.seen() : seen_exactly(state);
  constexpr double kFelt = 0.05;  // [weights]
  const StringState string = !camera                    ? state.string_state
                             : forces[0].norm() > kFelt ? StringState::kOnString
                                                        : StringState::kLoose;
  put3(seen.position - 0.5 * (left + right));
  put3(seen.velocity);
  put(seen.spin / kSpinSeenOver);
  for (const StringState one : {StringState::kOnString, StringState::kLoose, StringState::kFlying})
    put(string == one ? 1.0 : 0.0);
  put3(left - centre);
  put3(right - centre);
  for (const Vector3<double>& velocity : episode.hands.velocity) put3(velocity);
  for (std::size_t i = 0; i < kMostGoalNumbers; ++i) put(episode.goal[i] / task.goal[i].seen_over);
  put(episode.memory.flights);
  for (const Vector3<double>& force : forces) put3(force);
  put(episode.memory.stage);
  if (too.axle) {
    put3(seen.axis);
    put3(seen.axis_rate);
  }
  for (std::size_t i = 0; i < too.tasks; ++i) put(i == episode.task ? 1.0 : 0.0);
  if (!too.plan) return;
  const HandPlan::Moment& plan = planned_now(episode);
  put3(seen.position - plan.position);
  put3(seen.velocity - plan.velocity);
  for (std::size_t side = 0; side < 2; ++side) put3(episode.hands.position[side] - plan.hands.position[side]);
  for (std::size_t side = 0; side < 2; ++side) put3(episode.hands.velocity[side] - plan.hands.velocity[side]);
  for (const double share : plan.shares) put(share);
  put(episode.plan->time_left(static_cast<std::size_t>(episode.periods)));
}

}  // namespace diabolo
