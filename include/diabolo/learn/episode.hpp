// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "diabolo/learn/all_tasks.hpp"
#include "diabolo/learn/camera.hpp"
#include "diabolo/learn/draw.hpp"

namespace diabolo {

/// One environment: what is played in it, and how far.
struct Episode {
  std::uint64_t seed = 0, number = 0;  ///< number: of the next episode
  std::size_t model = 0;               ///< which one it is played with
  State<double> state;
  Hands hands;
  Vector3<double> rest = Vector3<double>::Zero();  ///< where the diabolo was at first [m]
  Vector3<double> pull = Vector3<double>::Zero();  ///< of the string, the mean over the last period [m/s^2]
  Goal goal{};
  Memory memory;
  Draw draw;
  Sight sight;              ///< of its camera, where there is one
  double first_spin = 0.0;  ///< [rad/s]
  double worth = 0.0;       ///< the sum of its rewards
  int periods = 0;          ///< that were played
  bool over = false;        ///< and it waits for its reset
  bool dropped = false;
};

/// What an episode may begin with in place of a hanging diabolo, as in the middle of somebody's play.
struct EpisodeStart {
  State<double> state;
  Hands hands;
  std::optional<Goal> goal{};  ///< none: it is drawn
  int stage = 0, flights = 0;  ///< see Memory
};

/// What the string does to the diabolo where an episode begins: it carries what hangs on it [m/s^2].
inline Vector3<double> first_pull(const State<double>& state, double gravity) {
  const bool held = state.string_state == StringState::kOnString;
  return (held ? gravity : 0.0) * Vector3<double>::UnitZ();
}

/// The same as its mean over a period that ends with the episode's state.
inline Vector3<double> mean_pull(const Episode& episode, const State<double>& before, double gravity,
                                 double period) {
  return (episode.state.velocity - before.velocity) / period + gravity * Vector3<double>::UnitZ();
}

/// A period that ends with the episode's state, as a task looks at it. It refers to what it is given.
inline Moment moment_of(const Episode& episode, const State<double>& before, const Vector3<double>& centre,
                        double gravity, double period) {
  return {.before = before,
          .after = episode.state,
          .hands = episode.hands,
          .centre = centre,
          .rest = episode.rest,
          .gravity = gravity,
          .period = period,
          .goal = episode.goal};
}

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

/// What an agent sees after these in a task that says so.
inline constexpr std::array kAxleObservations{
    ObservationInfo{"axle", "1", 3, "direction of the axle, forward"},
    ObservationInfo{"axle_rate", "1/s", 3, "of that direction"},
};

namespace learn_detail {

constexpr std::size_t size_of(const auto& infos) {
  std::size_t sum = 0;
  for (const ObservationInfo& info : infos) sum += info.size;
  return sum;
}

}  // namespace learn_detail

inline constexpr std::size_t kObservationSize = learn_detail::size_of(kObservations);  ///< without an axle
inline constexpr std::size_t kAxleSize = learn_detail::size_of(kAxleObservations);

/// How many numbers an agent sees of a task.
constexpr std::size_t observation_size(const TaskInfo& task) {
  return kObservationSize + (task.axle ? kAxleSize : 0);
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

/// Writes observation_size(task) numbers, none beyond kMostObserved. With `camera`, what it saw.
inline void observe(const Episode& episode, const TaskInfo& task, const Vector3<double>& centre, bool camera,
                    float* to) {
  std::array<double, kObservationSize + kAxleSize> seen_numbers;
  double* next = seen_numbers.data();
  const auto put = [&next](double x) { *next++ = x; };
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
  if (task.axle) {
    put3(seen.axis);
    put3(seen.axis_rate);
  }
  std::transform(seen_numbers.data(), next, to,
                 [](double x) { return static_cast<float>(std::clamp(x, -kMostObserved, kMostObserved)); });
}

/// Whether nobody can catch it any more: it flies far below the tips, or it is far from the box.
inline bool dropped(const Episode& episode, const Vector3<double>& centre, double string_length) {
  const Vector3<double>& p = episode.state.position;
  const double lower = std::min(episode.hands.position[0].z(), episode.hands.position[1].z());
  return (episode.state.string_state == StringState::kFlying && p.z() < lower - 0.6 * string_length) ||
         (p - centre).squaredNorm() > 9.0 * string_length * string_length;
}

}  // namespace diabolo
