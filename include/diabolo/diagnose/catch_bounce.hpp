// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/evidence.hpp"
#include "diabolo/diagnose/first_spring.hpp"
#include "diabolo/diagnose/refine.hpp"
#include "diabolo/diagnose/select.hpp"

namespace diabolo::diagnose_detail {

/// Shares of the path's rate that a catch may give back, to begin with. A string that is dead has no slope by
/// it, since it stays taut at any slight change; and whether the next catch comes in time leaves many
/// valleys.
inline constexpr double kTriedRestitutions[] = {0.2, 0.4, 0.6, 0.8};
/// Fits that end as near to each other are one.
inline constexpr double kSameValley = 0.03;
/// A bounce that costs so many times as much, all else as it is, is not worth a fit of all.
inline constexpr double kHopeless = 2.0;

/// Without a spring that gives: its own bounce would take that of a catch's place.
inline ActiveSet with_bounce(const ActiveSet& set) {
  const ActiveSet rigid =
      with(with(set, candidate_of("string_elasticity"), false), candidate_of("stick_flex"), false);
  return with(rigid, candidate_of("landing_restitution"));
}

/// The fit with catches that bounce, and what is free in it, where it is sure of that, it matters, and it
/// costs less by what a claim has to: in place of a spring, if it has one. Else nothing.
template <class D>
std::optional<std::pair<Fit, ActiveSet>> bouncing(const Fit& fit, const ActiveSet& set, const Model& physics,
                                                  int threads, const FitWatch& watch) {
  const Candidate& bounce = candidate_of("landing_restitution");
  const ActiveSet free = with_bounce(set), alone = with(ActiveSet::Constant(false), bounce);
  const auto is_sure = [&](const Fit& trial) {
    return speaks_for(bounce, significance(bounce, estimates_of(Evidence(trial), free)));
  };
  std::optional<Fit> best;
  std::vector<double> valleys;
  for (const double tried : kTriedRestitutions) {
    Fit trial = fit;
    put_at_rest(trial, free);
    double& share = trial.at[index_of(Unknown::kRestitution)];
    share = tried;
    trial.noise_is_known = true;  // lest it is taken from what the trial leaves
    refine<D>(trial, physics, alone, kMostIterations, threads, watch);
    const auto is_there = [&](double valley) { return std::abs(valley - share) < kSameValley; };
    if (trial.cost > kHopeless * fit.cost || !is_sure(trial) || std::ranges::any_of(valleys, is_there))
      continue;
    valleys.push_back(share);
    refine<D>(trial, physics, free, kMostIterations, threads, watch);
    if (watch.is_enough()) return std::nullopt;
    if ((!best || trial.cost < best->cost) && is_sure(trial)) best = std::move(trial);
  }
  if (!best) return std::nullopt;
  const double gain = fit.cost - cost_with_noise_of(fit, *best, threads);
  if (gain < kSignificance * kSignificance * fit.dispersion ||
      !(size_of(bounce, best->at, best->systems) > kSmallestReach))
    return std::nullopt;
  best->noise_is_known = fit.noise_is_known;
  return std::pair(*std::move(best), free);
}

}  // namespace diabolo::diagnose_detail
