// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "diabolo/diagnose/alternatives.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/first_spring.hpp"
#include "diabolo/diagnose/refine.hpp"
#include "diabolo/effects/finite_axle.hpp"
#include "diabolo/model.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"

// The string of a simulator may lie around no axle. To a fit whose string does, its recordings look as if the
// string were longer than told, or the tips elsewhere.
namespace diabolo::diagnose_detail {

/// Whether string and tips are as they were told, within what any measurement is off by.
inline bool is_as_told(const Estimates& now) {
  return std::ranges::none_of(std::array{"string_length", "stick_tip_offset"}, [&](const char* name) {
    const Candidate& fault = candidate_of(name);
    return speaks_for(fault, significance(fault, now)) && is_beyond_floor(fault, now);
  });
}

/// Whether the usual path from tip to tip is nearer the string's length than what of it is not around the
/// axle, in each recording where a path stands out.
inline bool is_as_long_as_the_string(const Fit& fit, const Model& physics) {
  const double around = kUsualContact * fit.centre[index_of(Unknown::kAxleRadius)];
  bool any = false;
  for (const FitTake& fit_take : fit.fit_takes) {
    const Recording& recording = fit_take.take->recording;
    const std::optional<double> path = usual_path_length(recording);
    if (!path) continue;
    if (*path < parameters_for(physics, recording).string_length - 0.5 * around) return false;
    any = true;
  }
  return any;
}

/// Whether a string around no axle is worth a fit: the path is as long as it, or string or tips are not as
/// they were told around one, and a turn of the string is not why.
inline bool may_be_thin(const Fit& fit, const ActiveSet& set, const Model& physics) {
  if (!physics.effects.get<FiniteAxle>().neutral()) return false;
  if (is_as_long_as_the_string(fit, physics)) return true;
  const Estimates now = estimates_of(Evidence(fit), set);
  return !is_as_told(now) && !is_as_long_with_a_wrap(now);
}

/// Where the base alone is, its string around no axle. That lies on the axle itself.
inline Fit begun_thin(Fit fit, const Model& physics) {
  fit.centre[index_of(Unknown::kThinAxle)] = 1.0;
  fit.centre[index_of(Unknown::kWraps)] = 0.0;
  fit.centre[index_of(Unknown::kAxleRadius)] =
      parameters_for(physics, fit.fit_takes.front().take->recording).axle_radius;
  fit.at = fit.centre;
  fit.noise_is_known = true;  // lest it is taken from what the trial leaves
  return fit;
}

/// The fit with a string that lies around no axle, from the base alone or from the physics that was found,
/// which costs less. It needs to do no worse than one with an axle where string and tips are as told, and
/// clearly better where they are not all the same; else nothing.
template <class D>
std::optional<Fit> with_thin_axle(const Fit& fit, const ActiveSet& set, const Model& physics, int threads,
                                  const FitWatch& watch) {
  Fit best = begun_thin(fit, physics), found = best;
  for (int u = 0; u < kUnknowns; ++u)
    if (!is_nuisance(static_cast<Unknown>(u))) found.at[u] = fit.at[u];
  found.at[index_of(Unknown::kThinAxle)] = 1.0;
  for (Fit* trial : {&best, &found})
    linearize<D>(*trial, physics, ActiveSet::Constant(false), threads, watch);
  if (found.cost < best.cost) best = std::move(found);
  approach<D>(best, physics, set, kMostIterations, threads, watch);
  const auto [thin, around] = costs_where_both_fit(best, with_noise_of(best, fit, threads));
  const double alike = kSameResidual * around + kAsGood * best.dispersion;
  if (thin > around + (is_as_told(estimates_of(Evidence(best), set)) ? alike : -alike)) return std::nullopt;
  best.noise_is_known = fit.noise_is_known;
  return best;
}

}  // namespace diabolo::diagnose_detail
