// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/plan/plan_problem.hpp"

namespace diabolo {

/// How far a plan is off one goal.
struct GoalCost {
  std::string name;
  double weight, error, tolerance;  ///< the cost is weight * error; reached where error <= tolerance
  std::string unit;                 ///< of error and tolerance; empty for a share
  bool reached;
};

/// A motion that was found, and what it leads to with the nominal model. Its path keeps the limits.
struct Plan {
  StickSpline<double> motion;
  TipPath<double> path;
  Play<double> play;
  std::vector<GoalCost> goals;
  double cost = 0.0;  ///< the paper's residual; over several models their mean
  std::vector<LimitUse> limits;
  bool reached = false;  ///< every goal within its tolerance
  std::string answer;    ///< the same in a sentence; where a goal is missed, with the limits that bind
  int evaluations = 0;   ///< motions that were predicted; one with derivatives counts once
};

/// How long a search may take. Both bounds count.
struct Budget {
  int evaluations = 100000;
  std::function<bool()> stop{};  ///< asked before each evaluation

  bool spent(int used) const { return used >= evaluations || (stop && stop()); }
};

/// True from so many seconds after its making on: for Budget::stop.
inline std::function<bool()> deadline(double seconds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  return [end] { return Clock::now() >= end; };
}

namespace plan_detail {

/// Limits that stand in the way of more, in a clause: those nearly used up, and those that one of the
/// `wanted` motions breaks, in whose place a slower or smaller one stands.
inline std::string binding_limits(const std::vector<LimitUse>& uses,
                                  const std::vector<std::vector<LimitUse>>& wanted) {
  std::ostringstream binding, broken;
  for (std::ostringstream* text : {&binding, &broken}) text->precision(3);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const LimitUse& use = uses[i];
    if (use.excess >= (use.unit == "m" ? -0.004 : -0.03)) {
      binding << (binding.tellp() > 0 ? ", " : "; what binds: ") << use.name << " (" << use.value << " of "
              << use.limit << ' ' << use.unit << " at " << use.time << " s)";
      continue;
    }
    const LimitUse* most = nullptr;  // of those that break it
    for (const std::vector<LimitUse>& of : wanted)
      if (i < of.size() && of[i].excess > (most == nullptr ? 0.0 : most->excess)) most = &of[i];
    if (most != nullptr)
      broken << (broken.tellp() > 0 ? ", " : "; slowed to keep: ") << use.name << " (" << most->value
             << " wanted, limit " << use.limit << ' ' << use.unit << ')';
  }
  return binding.str() + broken.str();
}

inline std::string answer_of(const Plan& plan, const std::vector<std::vector<LimitUse>>& wanted) {
  std::ostringstream text;
  text.precision(3);
  for (const GoalCost& goal : plan.goals) {
    if (goal.reached) continue;
    text << (text.tellp() > 0 ? "; " : "") << goal.name;
    if (goal.error > goal.tolerance)
      text << " is missed by " << goal.error << (goal.unit.empty() ? "" : " ") << goal.unit;
    else
      text << " does not come about";
  }
  if (text.tellp() == 0) return "every goal is reached";
  const std::string binding = binding_limits(plan.limits, wanted);
  text << (binding.empty() ? "; it is at no limit: more time, another seed or more freedom may do better"
                           : binding);
  return text.str();
}

/// The largest share in [0, 1] of the way from a motion that keeps the limits to another one at which they
/// are kept, and the motion there. For motions of the same times they are kept on all of the way before it.
template <class MotionAt>
double kept_share(const TipLimits& limits, double string_length, const MotionAt& motion_at) {
  const auto kept = [&](double share) { return keeps(path_of(motion_at(share)), limits, string_length); };
  if (kept(1.0)) return 1.0;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (kept(middle) ? low : high) = middle;
  }
  return low;
}

/// The motion between two with the same points and times in number.
inline StickSpline<double> between(const StickSpline<double>& a, const StickSpline<double>& b, double share) {
  StickSpline<double> result = a;
  for (std::size_t i = 0; i < a.points.size(); ++i)
    result.points[i] = a.points[i] + (b.points[i] - a.points[i]) * share;
  for (std::size_t i = 0; i < a.durations.size(); ++i)
    result.durations[i] = a.durations[i] + (b.durations[i] - a.durations[i]) * share;
  return result;
}

}  // namespace plan_detail

/// From where the tips are no motion keeps the limits.
class NoMotion : public std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// The seed, or where it breaks a limit one that keeps them all: the seed made slower, by half at most, or
/// smaller. Throws NoMotion that names the limit where nothing of it does.
inline StickSpline<double> kept_seed(const StickSpline<double>& seed, const TipLimits& limits,
                                     double string_length) {
  if (keeps(path_of(seed), limits, string_length)) return seed;
  const auto scaled = [&](double size, double pace) {
    StickSpline<double> result = seed;
    for (double& duration : result.durations) duration *= pace;
    for (std::size_t i = 1; i < result.points.size(); ++i)
      result.points[i] = seed.points[0] + (seed.points[i] - seed.points[0]) * size;
    return result;
  };
  for (int percent = 105; percent <= 150; percent += 5)
    if (StickSpline<double> slower = scaled(1.0, 0.01 * percent);
        keeps(path_of(slower), limits, string_length))
      return slower;
  const StickSpline<double> still = scaled(0.0, 1.0);
  const LimitUse broken = worst(limit_uses(path_of(still), limits, string_length));
  if (broken.excess > 0.0) {
    std::ostringstream text;
    text << "plan: no motion from this start keeps the limit of the " << broken.name << ", " << broken.limit
         << ' ' << broken.unit << ": it is " << broken.value
         << (seed.start ? " even where the tips come to rest at once" : " even where the tips stay");
    throw NoMotion(text.str());
  }
  return scaled(
      plan_detail::kept_share(limits, string_length, [&](double size) { return scaled(size, 1.0); }), 1.0);
}

/// What a motion that keeps the limits is worth. `wanted`: what those use of them in whose place it stands.
/// Its cost is infinite where a model predicts no numbers.
template <template <class> class... Effects>
Plan judged(const PlanProblem<Effects...>& problem, const StickSpline<double>& motion, int evaluations,
            const std::vector<std::vector<LimitUse>>& wanted = {}) {
  Plan plan;
  plan.motion = motion;
  plan.path = path_of(motion);
  constexpr double dt = PlanProblem<Effects...>::kReportedStep;
  plan.play = problem.played(0, problem.models.front(), plan.path, dt);
  for (const GoalError<double>& error :
       goal_errors(plan.play, problem.goals, problem.models.front().parameters(), false))
    plan.goals.push_back({error.name, error.weight, error.size(), error.tolerance, error.unit,
                          error.held && error.size() <= error.tolerance});
  plan.cost = problem.cost(plan.path, dt, false);
  plan.limits = limit_uses(plan.path, problem.limits, problem.string_length());
  plan.reached = std::ranges::all_of(plan.goals, &GoalCost::reached);
  plan.evaluations = evaluations;
  plan.answer = plan_detail::answer_of(plan, wanted);
  return plan;
}

/// A plan that was found. Throws std::invalid_argument where a model predicts no numbers for it.
inline Plan found(Plan plan) {
  if (plan.cost == INFINITY)
    throw std::invalid_argument(
        "plan: a model predicts no finite numbers for the best motion that was found");
  return plan;
}

}  // namespace diabolo
