// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/math/parallel.hpp"
#include "diabolo/plan/action_request.hpp"
#include "diabolo/plan/hang_at_rest.hpp"
#include "diabolo/plan/throw_and_catch.hpp"

namespace diabolo {

inline constexpr double kLongestPlay = 3600.0;       ///< [s]
inline constexpr double kLongestFlightShown = 10.0;  ///< after the end of a play [s]

namespace plan_detail {

/// One cycle of an action.
struct PlannedCycle {
  TipPath<double> path;
  std::vector<Plan> plans;
  Goals wanted;
};

/// Plans a cycle from the home pose, or one that goes on where the tips are at the end of `before`; `states`
/// are those of the diabolo, one for each model.
template <template <class> class... Effects>
PlannedCycle plan_cycle(const ActionRequest& wanted, const std::vector<Predictor<double, Effects...>>& models,
                        const std::vector<State<double>>& states, const TipPath<double>& before) {
  const std::string figure = wanted.figure();
  const double length = models.front().parameters().string_length;
  const ActionOptions usual;
  const ActionOptions options{wanted.size, wanted.pace,
                              wanted.height.value_or(figure == "hop" ? 0.15 : usual.height),
                              wanted.sideways.value_or(usual.sideways), wanted.spin_gain};
  Action action = action_named(figure, home_pose(figure, length), states.front(), length, options);
  action.seed.sticks = wanted.sticks;
  if (!before.empty()) {
    const auto tips = before.derivatives_at(before.end());
    action.seed.points.front() = tips[0];
    action.seed.start = SplineStart<double>{tips[1], tips[2]};
  }
  PlanProblem<Effects...> problem{models,        states.front(), action.seed,     action.goals,
                                  wanted.limits, action.freedom, wanted.search.dt};
  if (states.size() > 1) problem.starts = states;
  if (!wanted.catches()) {
    Plan plan = searched(problem, wanted.search);
    return {plan.path, {plan}, action.goals};
  }
  ThrowAndCatch both = plan_throw_and_catch(problem, GradientSearch{}, wanted.search.budget());
  PlannedCycle cycle{std::move(both.path), {std::move(both.thrown)}, action.goals};
  if (both.caught) cycle.plans.push_back(std::move(*both.caught));
  return cycle;
}

/// Where each model begins.
template <template <class> class... Effects>
std::vector<State<double>> starts_of(const ActionRequest& wanted,
                                     const std::vector<Predictor<double, Effects...>>& models) {
  const std::string figure = wanted.figure();
  const TipColumn<double> home = home_pose(figure, models.front().parameters().string_length);
  std::vector<State<double>> starts;
  for (const Predictor<double, Effects...>& model : models) {
    starts.push_back(wanted.start ? *wanted.start : hang_at_rest(model, home, wanted.spin, wanted.sticks));
    if (!wanted.start && figure == "stop") starts.back().velocity.y() = 0.8;  // something to stop
  }
  return starts;
}

/// Adds the cycles after the first one, or says why there are no more; `end` is the first one's path.
template <template <class> class... Effects>
void add_cycles(PlannedPlay& play_so_far, const ActionRequest& wanted,
                const std::vector<Predictor<double, Effects...>>& models, std::vector<State<double>> states) {
  TipPath<double> last = play_so_far.path;
  for (int cycle = 2; cycle <= wanted.cycles; ++cycle) {
    const auto end = [&](const std::string& why) {
      play_so_far.ended = "cycle " + std::to_string(cycle) + ": " + why;
    };
    for (std::size_t m = 0; m < models.size(); ++m)
      states[m] = play(models[m], states[m], last, {.dt = kShownStep}).end().state;
    if (states.front().string_state == StringState::kFlying)
      return end("the diabolo flies, nothing holds it");
    if (play_so_far.plans.size() < play_so_far.plans_per_cycle() * static_cast<std::size_t>(cycle - 1))
      return end("the throw before it was none");
    PlannedCycle next;
    try {
      next = plan_cycle(wanted, models, states, play_so_far.path);
    } catch (const std::invalid_argument& error) {
      std::string_view why = error.what();
      if (why.starts_with("plan: ")) why.remove_prefix(6);
      return end(std::string(why));
    }
    if (wanted.search.cancelled && wanted.search.cancelled()) throw Cancelled();
    if (play_so_far.path.end() + next.path.end() - next.path.begin() > kLongestPlay)
      return end("the play would last more than " + shown(kLongestPlay) + " s");
    play_so_far.path.append(next.path);
    for (Plan& plan : next.plans) play_so_far.plans.push_back(std::move(plan));
    last = std::move(next.path);
  }
}

}  // namespace plan_detail

/// Plans a figure of play from its home pose, for all models at once: their mean cost counts, and the first
/// one is the nominal one, whose string length decides the pose. There are fewer cycles than asked for, and
/// PlannedPlay::ended says why, where a throw leaves nothing to catch or no motion goes on within the limits.
/// Throws std::invalid_argument about bad input, and Cancelled.
template <template <class> class... Effects>
PlannedPlay plan_action(const ActionRequest& wanted,
                        const std::vector<Predictor<double, Effects...>>& models) {
  wanted.validate();
  if (models.empty()) throw std::invalid_argument("model: none; at least one expected");
  const std::vector<State<double>> starts = plan_detail::starts_of(wanted, models);
  const auto begin = std::chrono::steady_clock::now();
  plan_detail::PlannedCycle first = plan_detail::plan_cycle(wanted, models, starts, {});
  if (wanted.search.cancelled && wanted.search.cancelled()) throw Cancelled();
  PlannedPlay result;
  result.action = wanted.action;
  result.path = std::move(first.path);
  result.plans = std::move(first.plans);
  result.wanted = std::move(first.wanted);
  result.start = starts.front();
  plan_detail::add_cycles(result, wanted, models, starts);
  result.planning_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const TipColumn<double> hands = result.path.derivatives_at(result.path.end())[0];
  const bool caught = wanted.catches() && result.plans.size() % 2 == 0;
  result.play = play(models.front(), starts.front(), result.path,
                     {.dt = kShownStep,
                      .flight = caught ? 0.0 : kLongestFlightShown,
                      .down_to = 0.5 * (hands[2] + hands[5])});
  return result;
}

}  // namespace diabolo
