// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <stdexcept>
#include <vector>

#include "diabolo/player/gradient_search.hpp"
#include "diabolo/player/horizon.hpp"
#include "diabolo/player/motions.hpp"

namespace diabolo {

/// Catches a diabolo that flies: the string, all but straight, comes under the place where it falls through
/// the height of the hands, gives way, and the hands come home to `home`. Throws std::invalid_argument where
/// the diabolo does not fly, or comes down too soon.
inline Action catch_action(const Seam& seam, const TipColumn<double>& home, double string_length,
                           double catch_slack, double gravity) {
  if (seam.state.string_state != StringState::kFlying)
    throw std::invalid_argument("catch: the diabolo does not fly");
  const Vector3<double>&p = seam.state.position, &v = seam.state.velocity;
  const double level = 0.5 * (seam.tips[2] + seam.tips[5]);
  const double square = v.z() * v.z() + 2.0 * gravity * (p.z() - level);
  const double time = square > 0.0 ? (v.z() + std::sqrt(square)) / gravity : 0.0;
  if (time < 0.12) throw std::invalid_argument("catch: the diabolo comes down in less than 0.12 s");
  const Vector3<double> place = p + v * time;
  const double half = 0.5 * (string_length - 0.5 * catch_slack);
  const auto pose = [&](double half_gap, double z) {
    return detail::tips_column(place.x(), place.y() + half_gap, z, place.y() - half_gap, z);
  };
  Action action;
  action.name = "catch";
  action.seed.begin = seam.time;
  action.seed.points = {
      seam.tips, pose(half - 0.02, level), pose(half, level), pose(0.55 * half, level - 0.12), home, home};
  action.seed.durations = {0.7 * time, 0.3 * time, 0.3, 0.45, 0.25};
  action.seed.start = seam.start;
  action.freedom.times = false;
  action.freedom.last_point = false;
  action.freedom.forward = true;
  action.goals.caught = 1.0;
  const Vector3<double> rest = lowest_point(home.head<3>(), home.tail<3>(), string_length);
  action.goals.final_state = Waypoint{rest, Vector3<double>::Zero(), 0.3, 0.1, 0.0};
  action.goals.tolerances.position = 0.15;
  action.goals.tolerances.velocity = 1.0;
  return action;
}

/// A throw and the catch that follows it.
struct ThrowAndCatch {
  Plan thrown, caught;
  TipPath<double> path;  ///< of both
  bool reached = false;  ///< both
};

/// Plans a throw and, from its predicted end, the catch.
template <template <class> class... Effects>
ThrowAndCatch plan_throw_and_catch(const PlanProblem<Effects...>& throwing, const GradientSearch& search,
                                   const Budget& budget) {
  ThrowAndCatch result;
  result.thrown = search(throwing, budget);
  result.path = result.thrown.path;
  const PlayInstant<double>& end = result.thrown.play.end();
  if (end.state.string_state != StringState::kFlying) return result;
  const auto tips = result.path.derivatives_at(end.time);
  const Seam seam{end.time, tips[0], {tips[1], tips[2]}, end.state};
  const Parameters<double>& parameters = throwing.models.front().parameters();
  const Action action = catch_action(seam, throwing.seed.points.front(), parameters.string_length,
                                     parameters.catch_slack, parameters.gravity);
  PlanProblem<Effects...> catching = throwing;
  catching.start = seam.state;
  catching.seed = action.seed;
  catching.goals = action.goals;
  catching.freedom = action.freedom;
  result.caught = search(catching, budget);
  result.path.append(result.caught.path);
  result.reached = result.thrown.reached && result.caught.reached;
  return result;
}

}  // namespace diabolo
