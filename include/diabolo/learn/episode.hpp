// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "diabolo/learn/all_tasks.hpp"
#include "diabolo/learn/draw.hpp"

namespace diabolo {

/// One environment: what is played in it, and how far.
struct Episode {
  std::uint64_t seed = 0, number = 0;  ///< number: of the next episode
  std::size_t model = 0;               ///< which one it is played with
  State<double> state;
  Hands hands;
  Vector3<double> rest = Vector3<double>::Zero();  ///< where the diabolo hung at first [m]
  Goal goal{};
  Memory memory;
  int periods = 0;    ///< that were played
  bool over = false;  ///< and it waits for its reset
};

/// A slice of an observation.
struct ObservationInfo {
  std::string_view name, unit;
  std::size_t size;
  std::string_view meaning;
};

/// What an agent sees, in this order.
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
};

inline constexpr std::size_t kObservationSize = [] {
  std::size_t sum = 0;
  for (const ObservationInfo& info : kObservations) sum += info.size;
  return sum;
}();

/// Writes kObservationSize numbers.
inline void observe(const Episode& episode, const Vector3<double>& centre, float* to) {
  const auto put = [&to](double x) { *to++ = static_cast<float>(x); };
  const auto put3 = [&](const Vector3<double>& v) {
    for (const double x : v) put(x);
  };
  const auto& [left, right] = episode.hands.position;
  put3(episode.state.position - 0.5 * (left + right));
  put3(episode.state.velocity);
  put(episode.state.spin / 100.0);
  for (const StringState state : {StringState::kOnString, StringState::kLoose, StringState::kFlying})
    put(episode.state.string_state == state ? 1.0 : 0.0);
  put3(left - centre);
  put3(right - centre);
  for (const Vector3<double>& velocity : episode.hands.velocity) put3(velocity);
  for (const double number : episode.goal) put(number);
  put(episode.memory.flights);
}

/// Whether nobody can catch it any more: it flies far below the tips, or it is far from the box.
inline bool dropped(const Episode& episode, const Vector3<double>& centre, double string_length) {
  const Vector3<double>& p = episode.state.position;
  const double lower = std::min(episode.hands.position[0].z(), episode.hands.position[1].z());
  return (episode.state.string_state == StringState::kFlying && p.z() < lower - 0.6 * string_length) ||
         (p - centre).squaredNorm() > 9.0 * string_length * string_length;
}

}  // namespace diabolo
