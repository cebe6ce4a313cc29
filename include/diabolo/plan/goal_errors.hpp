// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "diabolo/plan/goals.hpp"
#include "diabolo/plan/play.hpp"
#include "diabolo/string/tip_geometry.hpp"

namespace diabolo {

/// For each waypoint the number of the instant closest to it: of the first one over the whole motion, then
/// always later than the one before, and neither the start nor the end (paper, section III-B).
template <class Scalar>
std::vector<std::size_t> matched_instants(const Play<Scalar>& play, const std::vector<Waypoint>& waypoints) {
  std::vector<std::size_t> result;
  std::size_t first = 1;
  for (std::size_t w = 0; w < waypoints.size(); ++w) {
    const std::size_t room = waypoints.size() - w;  // this one's and that of later ones
    const std::size_t last = std::max(first, play.planned > room + 1 ? play.planned - 1 - room : 0);
    std::size_t best = first;
    double least = INFINITY;
    for (std::size_t i = first; i <= last && i < play.planned; ++i) {
      double square = 0.0;
      for (int k = 0; k < 3; ++k) {
        const double d =
            static_cast<double>(value_of(play.instants[i].state.position[k])) - waypoints[w].position[k];
        square += d * d;
      }
      if (square < least) least = square, best = i;
    }
    result.push_back(best);
    first = best + 1;
  }
  return result;
}

namespace plan_detail {

/// Angle between two vectors, in three parts whose norm it is; smooth where it is zero.
template <class Scalar>
std::vector<Scalar> angle_parts(const Vector3<Scalar>& v, const Vector3<double>& wanted) {
  using std::atan2;
  const Vector3<Scalar> a = v * Scalar(Scalar(1) / norm(v)),
                        b = (wanted / std::max(wanted.norm(), 1e-12)).template cast<Scalar>();
  const Vector3<Scalar> apart = a - b, sum = a + b;
  const Scalar chord = norm(apart);
  const Scalar angle = Scalar(2) * atan2(chord, norm(sum));
  const bool small = any(chord < Scalar(1e-6));
  const Scalar stretch = small ? Scalar(1) : Scalar(angle / chord);
  return {Scalar(apart[0] * stretch), Scalar(apart[1] * stretch), Scalar(apart[2] * stretch)};
}

/// The errors of one waypoint, with the diabolo at `position` and `velocity`.
template <class Scalar>
void add_waypoint(const std::string& name, const Waypoint& wanted, const Goals::Tolerances& tolerances,
                  const Vector3<Scalar>& position, const Vector3<Scalar>& velocity,
                  std::vector<GoalError<Scalar>>& errors) {
  if (wanted.position_weight > 0.0) {
    const Vector3<Scalar> off = position - Vector3<Scalar>(wanted.position.template cast<Scalar>());
    errors.push_back(
        {name + " position", wanted.position_weight, tolerances.position, "m", {off[0], off[1], off[2]}});
  }
  if (wanted.velocity_weight > 0.0) {
    GoalError<Scalar> error{name + " velocity", wanted.velocity_weight, tolerances.velocity, "m/s", {}};
    if (wanted.velocity.isZero(0.0))  // the speed itself: its components are as large and smooth
      error.parts = {velocity[0], velocity[1], velocity[2]};
    else
      error.parts = {Scalar(norm(velocity) - Scalar(wanted.velocity.norm()))};
    errors.push_back(error);
  }
  if (wanted.direction_weight > 0.0)
    errors.push_back({name + " direction", wanted.direction_weight, tolerances.direction, "rad",
                      angle_parts(velocity, wanted.velocity)});
}

/// How much of the wanted pull is missing at each instant.
template <class Scalar>
GoalError<Scalar> slack_error(const Play<Scalar>& play, const Goals& goals) {
  GoalError<Scalar> error{"taut string", *goals.taut, goals.tolerances.taut, "", {}};
  const double share = 1.0 / std::sqrt(static_cast<double>(play.planned));
  for (std::size_t i = 1; i < play.planned; ++i) {
    const State<Scalar>& state = play.instants[i].state;
    const Scalar pull = norm(state.string_acceleration);
    if (pull < Scalar(kLeastPull))
      error.parts.push_back(Scalar(Scalar(1) - pull * Scalar(1.0 / kLeastPull)) * Scalar(share));
  }
  return error;
}

/// Height above the plane of the tips [m]; see height_above_tips().
template <class Scalar>
Scalar height_over_tips(const Vector3<Scalar>& point, const Tips<Scalar>& tips) {
  const Vector3<Scalar> span = tips.left - tips.right;
  const Scalar across = positive_sqrt<Scalar>(span.y() * span.y() + span.z() * span.z());
  return height_above_tips<Scalar>(point, tips.left, tips.right) / across;
}

/// Errors of the flight that a motion ends in.
template <class Scalar>
void add_flight(const Play<Scalar>& play, const Goals& goals, std::vector<GoalError<Scalar>>& errors) {
  const PlayInstant<Scalar>& end = play.end();
  // A release that is certain: the diabolo is well above the plane of the tips when they have come to rest.
  const Scalar missing = Scalar(kRelease) - height_over_tips<Scalar>(end.state.position, end.tips);
  const bool released = end.state.string_state == StringState::kFlying;
  errors.push_back({"height that a release needs", 1.0, 0.0, "m", {maximum(missing, Scalar(0))}, released});
  const double inverse = 0.5 / play.gravity;
  if (goals.apex) {
    std::size_t i = play.planned - 1;  // the last instant on the way up, or the first of the flight
    const auto flies = [&play](std::size_t k) {
      return play.instants[k].state.string_state == StringState::kFlying;
    };
    while (i > 0 && flies(i) && flies(i - 1) && play.instants[i].state.velocity.z() <= Scalar(0)) --i;
    while (i + 1 < play.instants.size() && play.instants[i + 1].state.velocity.z() > Scalar(0)) ++i;
    const State<Scalar>& state = play.instants[i].state;
    const Scalar tips = (end.tips.left.z() + end.tips.right.z()) * Scalar(0.5);
    const Scalar rise = state.velocity.z() * absolute<Scalar>(state.velocity.z()) * Scalar(inverse);
    errors.push_back({"apex",
                      goals.apex->weight,
                      goals.tolerances.position,
                      "m",
                      {Scalar(state.position.z() + rise - tips - Scalar(goals.apex->value))},
                      released});
  }
  if (goals.landing) {
    const Vector3<double>& wanted = goals.landing->position;
    std::size_t i = play.planned - 1;  // the last instant above it
    while (i + 1 < play.instants.size() && (play.instants[i + 1].state.velocity.z() > Scalar(0) ||
                                            play.instants[i + 1].state.position.z() > Scalar(wanted.z())))
      ++i;
    const State<Scalar>& state = play.instants[i].state;
    const Scalar height = state.position.z() - Scalar(wanted.z());
    const Scalar square = state.velocity.z() * state.velocity.z() + Scalar(2.0 * play.gravity) * height;
    const Scalar time = (state.velocity.z() + positive_sqrt<Scalar>(square)) * Scalar(1.0 / play.gravity);
    GoalError<Scalar> error{"landing", goals.landing->weight, goals.tolerances.position, "m", {}, released};
    for (int k = 0; k < 2; ++k)
      error.parts.push_back(state.position[k] + state.velocity[k] * time - Scalar(wanted[k]));
    errors.push_back(error);
  }
}

/// How much closer than the string is long the tips are meant to be in a catch [m]: hardly, even where a
/// slack string would do.
inline double meant_slack(double catch_slack) {
  return 0.5 * std::min(catch_slack, Parameters<double>().catch_slack);
}

/// How far a flight misses the string: where the diabolo comes down through the plane of the tips, from the
/// middle of their line, and how much the tips are too close there, which leaves the string too loose.
template <class Scalar>
void add_catch(const Play<Scalar>& play, const Goals& goals, double string_length, double slack,
               std::vector<GoalError<Scalar>>& errors) {
  GoalError<Scalar> error{"catch", *goals.caught, 0.1, "m", {}, false};
  for (std::size_t i = 1; i < play.planned; ++i) error.held = error.held || play.instants[i].caught;
  for (std::size_t i = 1; i < play.planned; ++i) {
    const PlayInstant<Scalar>&a = play.instants[i - 1], &b = play.instants[i];
    if (a.state.string_state != StringState::kFlying) break;
    const Scalar above = height_over_tips<Scalar>(a.state.position, a.tips);
    // What the step came to, or where it was caught, would have come to in free flight.
    const double dt = b.time - a.time;
    Vector3<Scalar> free = a.state.position + a.state.velocity * Scalar(dt);
    free.z() -= Scalar(0.5 * play.gravity * dt * dt);
    if (b.state.string_state == StringState::kFlying) free = b.state.position;
    const Scalar below = height_over_tips<Scalar>(free, b.tips);
    if (above <= Scalar(0) || (below > Scalar(0) && !b.caught)) continue;
    const Scalar fall = above - below;
    const Scalar f = fall > Scalar(0) ? Scalar(above / fall) : Scalar(1);
    const Vector3<Scalar> left = a.tips.left + (b.tips.left - a.tips.left) * f,
                          right = a.tips.right + (b.tips.right - a.tips.right) * f,
                          off =
                              a.state.position + (free - a.state.position) * f - (left + right) * Scalar(0.5),
                          span = left - right;
    const Scalar distance = norm(span);
    const Scalar along = dot<Scalar>(off, span) / distance;
    const Vector3<Scalar> across = off - span * Scalar(along / distance);
    error.parts = {across[0], across[1], across[2], Scalar(along * Scalar(0.3)),
                   Scalar(distance - Scalar(string_length - meant_slack(slack)))};
    break;
  }
  if (error.parts.empty())  // it never comes down through the plane
    error.parts = {height_over_tips<Scalar>(play.end().state.position, play.end().tips)};
  errors.push_back(error);
}

}  // namespace plan_detail

/// How far a play is off its goals. `smooth`: the instant closest to a waypoint is looked for between those
/// predicted too, and moves with the motion; else, as in the paper, it is one of them.
template <class Scalar>
std::vector<GoalError<Scalar>> goal_errors(const Play<Scalar>& play, const Goals& goals,
                                           const Parameters<double>& parameters, bool smooth) {
  std::vector<GoalError<Scalar>> errors;
  const std::vector<std::size_t> matched = matched_instants(play, goals.waypoints);
  for (std::size_t w = 0; w < matched.size(); ++w) {
    const State<Scalar>& state = play.instants[std::min(matched[w], play.planned - 1)].state;
    Vector3<Scalar> position = state.position, velocity = state.velocity;
    if (smooth) {
      const Vector3<Scalar> off = position - Vector3<Scalar>(goals.waypoints[w].position.cast<Scalar>());
      Vector3<Scalar> acceleration = state.string_acceleration;
      acceleration.z() -= Scalar(play.gravity);
      const double dt = play.instants[1].time - play.instants[0].time;
      const Scalar later = -dot<Scalar>(off, velocity) / (squared_norm(velocity) + Scalar(1e-4));
      const Scalar t = minimum(maximum(later, Scalar(-dt)), Scalar(dt));
      position = position + velocity * t;
      velocity = velocity + acceleration * t;
    }
    plan_detail::add_waypoint("waypoint " + std::to_string(w + 1), goals.waypoints[w], goals.tolerances,
                              position, velocity, errors);
  }
  const State<Scalar>& last = play.end().state;
  if (goals.final_state)
    plan_detail::add_waypoint("final", *goals.final_state, goals.tolerances, last.position, last.velocity,
                              errors);
  if (goals.spin)
    errors.push_back({"spin",
                      goals.spin->weight,
                      goals.tolerances.spin,
                      "rad/s",
                      {Scalar(last.spin - Scalar(goals.spin->value))}});
  if (goals.taut) errors.push_back(plan_detail::slack_error(play, goals));
  if (goals.throws()) plan_detail::add_flight(play, goals, errors);
  if (goals.caught)
    plan_detail::add_catch(play, goals, parameters.string_length, parameters.catch_slack, errors);
  return errors;
}

/// The paper's residual: the sum of all costs.
template <class Scalar>
double total_cost(const std::vector<GoalError<Scalar>>& errors) {
  double sum = 0.0;
  for (const GoalError<Scalar>& error : errors) sum += error.weight * error.size();
  return sum;
}

}  // namespace diabolo
