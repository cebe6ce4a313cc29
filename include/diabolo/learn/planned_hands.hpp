// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "diabolo/learn/hand_plan.hpp"
#include "diabolo/plan/planned_play.hpp"

namespace diabolo {

/// What moves the middle of a play's tips at first there [m].
inline Vector3<double> shift_to(const Vector3<double>& centre, const PlannedPlay& planned) {
  const Tips<double> tips = planned.path.at(planned.path.begin());
  return centre - 0.5 * (tips.left + tips.right);
}

/// Where a plan's hands and diabolo are at a time of its play [s]; `shift` [m] moves it into the hands' box.
inline HandPlan::Moment moment_at(const PlannedPlay& planned, double time, const Vector3<double>& shift) {
  const std::vector<PlayInstant<double>>& instants = planned.play.instants;
  const auto after = std::ranges::lower_bound(instants, time, {}, &PlayInstant<double>::time);
  const PlayInstant<double>& next = after == instants.end() ? instants.back() : *after;
  const PlayInstant<double>& last = after == instants.begin() ? next : *std::prev(after);
  const double between = next.time - last.time, share = between > 0.0 ? (time - last.time) / between : 0.0;
  const auto mixed = [share](const Vector3<double>& from, const Vector3<double>& to) -> Vector3<double> {
    return from + std::clamp(share, 0.0, 1.0) * (to - from);
  };
  const Tips<double> tips = planned.path.at(time);
  return {.hands = {{tips.left + shift, tips.right + shift}, {tips.left_velocity, tips.right_velocity}},
          .position = mixed(last.state.position, next.state.position) + shift,
          .velocity = mixed(last.state.velocity, next.state.velocity)};
}

/// A planned play for an agent's hands, which have the path's velocities at the begin of each period and
/// constant accelerations between. Their places are then off the path by up to T^2 / 12 times the change of
/// its acceleration, for a period T: a millimetre at 50 Hz. Where a limit of theirs is in the way, the plan
/// is what they do then.
inline HandPlan planned_hands(const PlannedPlay& planned, const Vector3<double>& shift,
                              const HandLimits& limits, double string_length, double period) {
  const double begin = planned.path.begin(), duration = planned.path.end() - begin;
  const auto count = static_cast<std::size_t>(std::ceil(duration / period - 1e-9));
  HandPlan plan{.period = period, .moments = {}};
  Hands hands = moment_at(planned, begin, shift).hands;
  for (std::size_t i = 0; i <= count; ++i) {
    HandPlan::Moment moment = moment_at(planned, begin + period * static_cast<double>(i), shift);
    const Hands next = moment_at(planned, begin + period * static_cast<double>(i + 1), shift).hands;
    moment.hands = hands;
    for (std::size_t k = 0; i < count && k < moment.shares.size(); ++k) {
      const auto axis = static_cast<Eigen::Index>(k % 3);
      moment.shares[k] =
          (next.velocity[k / 3][axis] - hands.velocity[k / 3][axis]) / (limits.acceleration * period);
    }
    plan.moments.push_back(moment);
    move_hands(hands, moment.shares.data(), limits, string_length, period);
  }
  return plan;
}

/// How far a plan's hands come off its path [m].
inline double farthest_off(const HandPlan& plan, const PlannedPlay& planned, const Vector3<double>& shift) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < plan.moments.size(); ++i) {
    const double time = planned.path.begin() + plan.period * static_cast<double>(i);
    const Hands wanted = moment_at(planned, time, shift).hands;
    for (std::size_t side = 0; side < 2; ++side)
      farthest = std::max(farthest, (plan.moments[i].hands.position[side] - wanted.position[side]).norm());
  }
  return farthest;
}

}  // namespace diabolo
