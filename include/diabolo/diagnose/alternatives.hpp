// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/findings.hpp"

namespace diabolo {

/// Another explanation of a fault, which takes the place of the first in a fit of its own.
struct Alternative {
  std::string_view name;
  Delay delay;
  ActiveSet set;
};

/// The explanations that are as good as the best one, which `fit`, `bank` and `set` are moved to.
struct Exchange {
  std::string_view name;               ///< of the best
  std::vector<std::string> tied_with;  ///< others that do as well
};

/// Refits with each alternative to a claimed fault and keeps the best. A pure delay, a low pass and a lagging
/// servo differ in the second order of the delay only; a wrong rate of the frames looks like a wrong scale on
/// a string of another length. `draft` holds what is claimed before.
template <class D = detail::FitDual>
std::vector<Exchange> exchange_faults(Fit& fit, Bank& bank, ActiveSet& set, const Diagnosis& draft,
                                      const Model& base, int threads, const Watch& watch) {
  std::vector<Exchange> result;
  for (const Finding& finding : draft.findings) {
    if (!finding.claimed) continue;
    std::vector<Alternative> others;
    if (finding.candidate->name == "time_offset" && fit.at[index_of(Unknown::kTimeOffset)] < 0.0) {
      others.push_back({"filter_lag", Delay::kFilter, set});
      others.push_back({"robot_servo_lag", Delay::kServo, set});
    }
    if (finding.candidate->name == "length_scale" && !set[index_of(Unknown::kGravity)]) {
      ActiveSet rate = set;
      rate[index_of(Unknown::kLengthScale)] = false;
      rate[index_of(Unknown::kGravity)] = true;
      others.push_back({"frame_rate", fit.delay, rate});
    }
    if (others.empty()) continue;
    Fit same = fit;
    same.noise_is_known = true;
    refine<D>(same, base, set, 2, threads, watch);
    std::vector<std::pair<double, std::string_view>> costs{{same.cost, finding.candidate->name}};
    const double dispersion = Evidence(same).dispersion();
    Fit best = same;
    ActiveSet best_set = set;
    for (const Alternative& other : others) {
      Fit trial = fit;
      trial.noise_is_known = true;
      trial.delay = other.delay;
      for (int u = 0; u < kUnknowns; ++u)
        if (!other.set[u]) trial.at[u] = trial.centre[u];
      refine<D>(trial, base, other.set, 6, threads, watch);
      costs.emplace_back(trial.cost, other.name);
      if (trial.cost < best.cost) best = std::move(trial), best_set = other.set;
    }
    std::ranges::sort(costs);
    Exchange exchange{costs.front().second, {}};
    for (const auto& [cost, name] : costs)
      if (name != exchange.name && cost - costs.front().first < 9.0 * dispersion)
        exchange.tied_with.emplace_back(name);
    std::ranges::replace_if(
        bank, [&](const Candidate* c) { return c == finding.candidate; }, &candidate_of(exchange.name));
    fit = std::move(best);
    fit.noise_is_known = false;
    set = best_set;
    result.push_back(std::move(exchange));
  }
  return result;
}

}  // namespace diabolo
