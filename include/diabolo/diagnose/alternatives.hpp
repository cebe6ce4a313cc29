// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/findings.hpp"

namespace diabolo {

/// Explanations predict the same where the squares of what they leave differ by less than this share, beside
/// three standard deviations' worth: the model itself is no better.
inline constexpr double kSameResidual = 0.01;

/// Another explanation, which takes the place of the first in a fit of its own.
struct Alternative {
  std::string_view name;
  Delay delay;
  ActiveSet set;
  UnknownVector at;  ///< to begin with
};

/// What took a claim's place, or kept it, and what does as well.
struct Exchange {
  std::string_view name;               ///< of the best
  std::vector<std::string> tied_with;  ///< others that do as well
};

/// `fit` with one unknown's part taken by another.
inline Alternative exchanged(const Fit& fit, const ActiveSet& set, std::string_view from, std::string_view to,
                             double share) {
  const Candidate &old = candidate_of(from), &young = candidate_of(to);
  Alternative result{to, fit.delay, with(with(set, old, false), young), fit.at};
  result.at[index_of(first_of(young))] =
      std::min(info_of(first_of(young)).maximum, share * fit.at[index_of(first_of(old))]);
  // Two sticks are two springs in a row with their dashpots.
  if (to == "stick_flex")
    result.at[index_of(Unknown::kStickDamping)] = 2.0 * fit.at[index_of(Unknown::kDamping)];
  if (to == "string_elasticity")
    result.at[index_of(Unknown::kDamping)] = 0.5 * fit.at[index_of(Unknown::kStickDamping)];
  return result;
}

/// What else may explain what is claimed under this name. A pure delay, a low pass and a lagging servo differ
/// in the second order of the delay only; a wrong rate of the frames looks like a wrong scale on a string of
/// another length; wind in a drag like a tilt; the give of string and sticks by the sticks' directions; the
/// laws of drag by the speeds; friction slows the spin as a bearing does.
inline std::vector<Alternative> alternatives_to(std::string_view name, const Fit& fit, const ActiveSet& set) {
  constexpr double kUsualSpeed = 2.0;  // [m/s]
  std::vector<Alternative> others;
  const auto absent = [&](std::string_view other) { return !is_in(set, candidate_of(other)); };
  if (name == "time_offset" && fit.at[index_of(Unknown::kTimeOffset)] < 0.0) {
    others.push_back({"filter_lag", Delay::kFilter, set, fit.at});
    others.push_back({"robot_servo_lag", Delay::kServo, set, fit.at});
  } else if (name == "length_scale" && !set[index_of(Unknown::kGravity)]) {
    ActiveSet rate = set;
    rate[index_of(Unknown::kLengthScale)] = false;
    rate[index_of(Unknown::kGravity)] = true;
    others.push_back({"frame_rate", fit.delay, rate, fit.at});
  } else if (name == "gravity_tilt" && absent("wind") && !absent("air_drag_quadratic")) {
    // (In a drag that is linear it is exactly that tilt: nothing could tell, and a tilt is the likelier one.)
    Alternative wind{"wind", fit.delay, with(with(set, candidate_of("wind")), candidate_of(name), false),
                     fit.at};
    others.push_back(wind);
  } else if ((name == "axle_drag" || name == "spin_drag") && absent("string_friction")) {
    others.push_back(exchanged(fit, set, name, "string_friction", 0.0));
    others.back().at[index_of(Unknown::kFriction)] = 0.1;
  } else if (name == "string_elasticity" && absent("stick_flex")) {
    others.push_back(exchanged(fit, set, name, "stick_flex", 0.5));
  } else if (name == "stick_flex" && absent("string_elasticity")) {
    others.push_back(exchanged(fit, set, name, "string_elasticity", 2.0));
  } else if (name == "air_drag_linear" && absent("air_drag_quadratic")) {
    others.push_back(exchanged(fit, set, name, "air_drag_quadratic", 1.0 / kUsualSpeed));
  } else if (name == "air_drag_quadratic" && absent("air_drag_linear")) {
    others.push_back(exchanged(fit, set, name, "air_drag_linear", kUsualSpeed));
  }
  return others;
}

/// Refits with each alternative to a claim and keeps the best. `draft` holds what is claimed before; `fit`,
/// `bank` and `set` are moved to what is best.
template <class D = detail::FitDual>
std::vector<Exchange> exchange_claims(Fit& fit, Bank& bank, ActiveSet& set, const Diagnosis& draft,
                                      const Model& base, int threads, const Watch& watch) {
  std::vector<Exchange> result;
  const bool any = std::ranges::any_of(draft.findings, [&](const Finding& f) {
    return f.claimed && !alternatives_to(f.candidate->name, fit, set).empty();
  });
  constexpr int kIterations = 8;  // as many for the claim as for what may replace it
  fit.noise_is_known = true;      // from here on, so that costs can be compared
  Fit before = fit;
  if (any) refine<D>(fit, base, set, kIterations, threads, watch);
  for (const Finding& finding : draft.findings) {
    if (!finding.claimed) continue;
    const std::vector<Alternative> others = alternatives_to(finding.candidate->name, fit, set);
    if (others.empty()) continue;
    std::vector<std::pair<double, std::string_view>> costs{{fit.cost, finding.candidate->name}};
    const double dispersion = Evidence(fit).dispersion();
    Fit best = fit;
    ActiveSet best_set = set;
    for (const Alternative& other : others) {
      const bool known = std::ranges::any_of(bank, [&](const Candidate* c) {
        return c->name == other.name || c->name == alternative_to(other.name);
      });
      if (!known) continue;
      Fit trial = before;
      trial.delay = other.delay;
      trial.at = other.at;
      for (int u = 0; u < kUnknowns; ++u)
        if (!other.set[u]) trial.at[u] = trial.centre[u];
      refine<D>(trial, base, other.set, kIterations, threads, watch);
      costs.emplace_back(trial.cost, other.name);
      if (trial.cost < best.cost) best = std::move(trial), best_set = other.set;
    }
    // A fault stays what it is where nothing else is better: the others are rarer.
    const double least = best.cost, worse = 9.0 * dispersion + kSameResidual * least;
    const bool stays = finding.candidate->kind == CandidateKind::kMeasurement && fit.cost - least < worse;
    if (stays) best = fit, best_set = set;
    std::ranges::sort(costs);
    Exchange exchange{stays ? finding.candidate->name : costs.front().second, {}};
    for (const auto& [cost, name] : costs)
      if (name != exchange.name && cost - least < worse) exchange.tied_with.emplace_back(name);
    if (!alternative_to(exchange.name).empty())
      std::ranges::replace_if(
          bank, [&](const Candidate* c) { return c == finding.candidate; }, &candidate_of(exchange.name));
    if (exchange.name != finding.candidate->name) before = best;
    fit = std::move(best);
    set = best_set;
    result.push_back(std::move(exchange));
  }
  return result;
}

}  // namespace diabolo
