// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/plan/gradient_search.hpp"
#include "diabolo/plan/motions.hpp"
#include "diabolo/plan/receding_horizon.hpp"

namespace diabolo {

/// Falls that are farther apart in time than this have a point of the catch each [s].
inline constexpr double kSpreadOfCatches = 0.01;

/// The hands need so long to come under a diabolo that falls [s].
inline constexpr double kLeastFall = 0.12;

namespace plan_detail {

/// When after now a flying diabolo falls through a height [s], and where [m].
struct Fall {
  double time;
  Vector3<double> place;
};

inline Fall fall_to(const State<double>& state, double level, double gravity) {
  const Vector3<double>&p = state.position, &v = state.velocity;
  const double square = v.z() * v.z() + 2.0 * gravity * (p.z() - level);
  const double time = square > 0.0 ? (v.z() + std::sqrt(square)) / gravity : 0.0;
  return {time, p + v * time};
}

/// The same of one that can be caught. Throws std::invalid_argument where it does not fly, or comes down in
/// less than kLeastFall.
inline Fall fall_to_catch(const State<double>& state, double level, double gravity) {
  if (state.string_state != StringState::kFlying)
    throw std::invalid_argument("catch: the diabolo does not fly");
  Fall fall = fall_to(state, level, gravity);
  if (fall.time < kLeastFall)
    throw std::invalid_argument("catch: the diabolo comes down in less than " + shown(kLeastFall) + " s");
  return fall;
}

}  // namespace plan_detail

/// Catches a diabolo that flies: the string, all but straight, comes under the place where it falls through
/// the height of the hands, gives way, and the hands come home to `home`. Where not only seam.state but
/// `others` are possible too, the string is there under the middle of their places, from before the first
/// fall until after the last: what was foreseen are examples, so that it takes three times their spread.
/// Throws std::invalid_argument where a diabolo does not fly, or comes down too soon.
inline Action catch_action(const Seam& seam, const TipColumn<double>& home, double string_length,
                           double catch_slack, double gravity,
                           const std::vector<State<double>>& others = {}) {
  const double level = 0.5 * (seam.tips[2] + seam.tips[5]);
  check_state("catch: the diabolo", seam.state);
  for (const State<double>& other : others) check_state("catch: the diabolo as it may be too", other);
  const plan_detail::Fall nominal = plan_detail::fall_to_catch(seam.state, level, gravity);
  double first = nominal.time, last = nominal.time;
  Vector3<double> lowest = nominal.place, highest = nominal.place;
  for (const State<double>& other : others) {
    const plan_detail::Fall fall = plan_detail::fall_to_catch(other, level, gravity);
    first = std::min(first, fall.time);
    last = std::max(last, fall.time);
    lowest = lowest.cwiseMin(fall.place);
    highest = highest.cwiseMax(fall.place);
  }
  const Vector3<double> place = 0.5 * (lowest + highest);
  const double half = 0.5 * (string_length - plan_detail::meant_slack(catch_slack));
  const auto pose = [&](double half_gap, double z) {
    return plan_detail::tips_column(place.x(), place.y() + half_gap, z, place.y() - half_gap, z);
  };
  Action action;
  action.name = "catch";
  action.seed.begin = seam.time;
  const double early = std::max(first - (last - first), 0.7 * first), late = last + (last - first);
  action.seed.points = {seam.tips, pose(half - 0.02, level), pose(half, level)};
  action.seed.durations = {0.7 * early, 0.3 * early};
  if (late - early > kSpreadOfCatches) {  // it waits
    action.seed.points.push_back(pose(half, level));
    action.seed.durations.push_back(late - early);
  }
  for (const TipColumn<double>& point : {pose(0.55 * half, level - 0.12), home, home})
    action.seed.points.push_back(point);
  for (const double duration : {0.3, 0.45, 0.25}) action.seed.durations.push_back(duration);
  action.seed.start = seam.start;
  action.seed.sticks = seam.sticks;
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
  Plan thrown;
  std::optional<Plan> caught;  ///< where something flies that can be caught
  TipPath<double> path;        ///< of both
  bool reached = false;        ///< both
};

/// Plans a throw and, from its predicted end, the catch: with several models, of every flight that one of
/// them predicts and that leaves time to catch it. Where the first one's leaves none, that is one more goal
/// of the throw that is missed.
template <template <class> class... Effects>
ThrowAndCatch plan_throw_and_catch(const PlanProblem<Effects...>& throwing, const GradientSearch& search,
                                   const Budget& budget) {
  ThrowAndCatch result;
  result.thrown = search(throwing, budget);
  result.path = result.thrown.path;
  PlanProblem<Effects...> catching = throwing;
  catching.models.clear();
  catching.starts.clear();
  const double time = result.path.end();
  const auto tips = result.path.derivatives_at(time);
  for (std::size_t m = 0; m < throwing.models.size(); ++m) {
    const State<double> end =
        throwing.played(m, throwing.models[m], result.path, throwing.kReportedStep).end().state;
    const double fall =
        plan_detail::fall_to(end, 0.5 * (tips[0][2] + tips[0][5]), throwing.models[m].parameters().gravity)
            .time;
    const bool flies = end.string_state == StringState::kFlying;
    if (m == 0 && flies && fall < kLeastFall) {
      Plan& thrown = result.thrown;
      thrown.goals.push_back({"time to catch", 1.0, kLeastFall - fall, 0.0, "s", false});
      thrown.cost += thrown.goals.back().error;
      const std::string short_of =
          "time to catch is missed by " + shown_rounded(kLeastFall - fall) + " s: a higher throw leaves more";
      thrown.answer = thrown.reached ? short_of : short_of + "; " + thrown.answer;
      thrown.reached = false;
    }
    if (!flies || fall < kLeastFall) {
      if (m == 0) return result;
      continue;
    }
    catching.models.push_back(throwing.models[m]);
    catching.starts.push_back(end);
  }
  catching.start = catching.starts.front();
  const Seam seam{time, tips[0], {tips[1], tips[2]}, throwing.seed.sticks, catching.start};
  const Parameters<double>& parameters = throwing.models.front().parameters();
  const Action action = catch_action(seam, throwing.seed.points.front(), throwing.string_length(),
                                     parameters.catch_slack, parameters.gravity, catching.starts);
  catching.seed = action.seed;
  catching.goals = action.goals;
  catching.freedom = action.freedom;
  try {
    result.caught = search(catching, budget);
  } catch (const NoMotion& error) {  // such as tips that are too far apart after it
    result.thrown.answer = std::string("nothing can catch it: ") + error.what();
    result.thrown.reached = false;
    return result;
  }
  result.path.append(result.caught->path);
  result.reached = result.thrown.reached && result.caught->reached;
  return result;
}

}  // namespace diabolo
