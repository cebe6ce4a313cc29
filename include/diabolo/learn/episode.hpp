// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "diabolo/learn/camera.hpp"
#include "diabolo/learn/draw.hpp"
#include "diabolo/learn/hand_plan.hpp"
#include "diabolo/learn/task.hpp"

namespace diabolo {

/// One environment: what is played in it, and how far.
struct Episode {
  std::uint64_t seed = 0, number = 0;      ///< number: of the next episode
  std::size_t model = 0;                   ///< which one it is played with
  std::size_t task = 0;                    ///< which one is played
  std::shared_ptr<const HandPlan> plan{};  ///< whose motion the actions correct; null: they are the motion
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
  std::optional<Goal> goal{};              ///< none: it is drawn
  int stage = 0, flights = 0;              ///< see Memory
  std::string task{};                      ///< whose it is; empty: of any
  std::shared_ptr<const HandPlan> plan{};  ///< which the hands follow from its first moment on; null: none

  bool is_of(std::string_view name) const { return task.empty() || task == name; }
};

/// The moment of its plan, which it has, in which an episode is.
inline const HandPlan::Moment& planned_now(const Episode& episode) {
  return episode.plan->at(static_cast<std::size_t>(episode.periods));
}

/// Moves an episode's hands for a period [s], by the action alone or by the plan that it corrects: see the
/// move_hands() of hands.
inline void move_hands(Episode& episode, const float* action, const HandLimits& limits, double string_length,
                       double period) {
  if (!episode.plan) return move_hands(episode.hands, action, limits, string_length, period);
  const HandShares shares = episode.plan->corrected(static_cast<std::size_t>(episode.periods), action,
                                                    episode.hands, limits.acceleration);
  move_hands(episode.hands, shares.data(), limits, string_length, period);
}

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

/// Whether nobody can catch it any more: it flies far below the tips, or it is far from the box.
inline bool dropped(const Episode& episode, const Vector3<double>& centre, double string_length) {
  const Vector3<double>& p = episode.state.position;
  const double lower = std::min(episode.hands.position[0].z(), episode.hands.position[1].z());
  return (episode.state.string_state == StringState::kFlying && p.z() < lower - 0.6 * string_length) ||
         (p - centre).squaredNorm() > 9.0 * string_length * string_length;
}

}  // namespace diabolo
