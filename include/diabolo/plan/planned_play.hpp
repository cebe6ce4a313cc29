// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/plan/plan.hpp"

namespace diabolo {

/// The action whose cycles have two plans: a throw and the catch that follows it.
inline constexpr std::string_view kThrowAndCatch = "throw_and_catch";

/// A planned motion, and what it leads to by the first of the models that it was planned with.
struct PlannedPlay {
  std::string action;
  TipPath<double> path;        ///< of the tips
  std::vector<Plan> plans;     ///< one a cycle; of a throw and catch two, or one where nothing can be caught
  Goals wanted;                ///< of the first cycle
  State<double> start;         ///< of the diabolo
  Play<double> play;           ///< what it does, kShownStep apart; a flight at the end comes down
  double planning_time = 0.0;  ///< of all plans together [s]
  std::string ended;           ///< why there are fewer cycles than were asked for; empty where there are not

  std::size_t plans_per_cycle() const { return action == kThrowAndCatch ? 2 : 1; }

  /// Whether every goal of every cycle is reached.
  bool reached() const { return ended.empty() && std::ranges::all_of(plans, &Plan::reached); }

  /// The same in a sentence: that of the first plan that misses a goal, or why there are no more.
  std::string answer() const {
    const std::size_t each = plans_per_cycle();
    const bool several = plans.size() > each || !ended.empty();
    for (std::size_t i = 0; i < plans.size(); ++i)
      if (!plans[i].reached)
        return (several ? "cycle " + std::to_string(i / each + 1) + ": " : "") + plans[i].answer;
    return ended.empty() ? "every goal is reached" : ended;
  }
};

}  // namespace diabolo
