// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/refine.hpp"
#include "diabolo/diagnose/residual_and_noise.hpp"
#include "diabolo/diagnose/select.hpp"

// Recordings that are fitted together share every number. Where they do not, the fit settles for some of them
// and takes the others for noise; so each is asked by itself.
namespace diabolo {

/// Estimates that were made apart, one less the other.
inline Estimates less(const Estimates& a, const Estimates& b) {
  return {a.estimate - b.estimate, a.noise + b.noise, a.spread + b.spread};
}

/// Whether two differ by more than is unsure, and by enough to matter; `size` is that of the difference.
inline bool differs(const Candidate& candidate, const Estimates& difference, double size) {
  const Unknown first = first_of(candidate);
  if (!(difference.deviation(index_of(first)) > 0.0)) return difference.estimate[index_of(first)] != 0.0;
  if (candidate.floor > 0.0) return is_beyond_floor(candidate, difference);
  return std::abs(significance(candidate, difference)) > kSignificance &&
         size > (is_of_spin(candidate)   ? kSmallestSpinShare
                 : is_of_axle(candidate) ? kSmallestTurn
                                         : kSmallestReach);
}

namespace diagnose_detail {

/// One take of a fit, fitted by itself from there. Patient at first: what was taken for noise may be what is
/// different about it.
template <class D>
Fit fitted_alone(const Fit& fit, std::size_t take, const Model& physics, const ActiveSet& set, int threads,
                 const FitWatch& watch) {
  Fit alone = fit;
  alone.fit_takes = {fit.fit_takes[take]};
  alone.noise = {fit.noise[take]};
  alone.systems.clear();
  alone.noise_is_known = false;
  alone.far_window = kFarWindowAtFirst;
  approach<D>(alone, physics, set, kMostIterations, threads, watch);
  alone.far_window = kFarWindow;
  approach<D>(alone, physics, set, kMostIterations, threads, watch);
  return alone;
}

/// What each take with enough windows says by itself; of the others nothing.
template <class D>
std::vector<std::optional<Evidence>> evidence_alone(const Fit& fit, const Model& physics,
                                                    const ActiveSet& set, int threads,
                                                    const FitWatch& watch) {
  std::vector<std::optional<Evidence>> result(fit.fit_takes.size());
  for (std::size_t s = 0; s < fit.fit_takes.size(); ++s) {
    if (fit.fit_takes[s].windows.size() < kStretch) continue;
    Fit alone = fitted_alone<D>(fit, s, physics, set, threads, watch);
    linearize<D>(alone, physics, threads, watch);
    if (watch.is_enough()) return {};
    result[s] = Evidence(alone);
  }
  return result;
}

/// Whether a take by itself asks for a sign that the law cannot have, or for a fault farther off than any
/// measurement: its number stands for something else then.
inline bool has_no_sense(const Candidate& candidate, const Estimates& alone) {
  return (candidate.positive && significance(candidate, alone) < -kMayBe) ||
         (candidate.kind == CandidateKind::kMeasurement && !is_possible(candidate, alone));
}

/// The two takes that differ most in something; nothing where none do.
inline std::optional<Differing> difference_of_takes(const Candidate& candidate, const Fit& fit,
                                                    const std::vector<std::optional<Evidence>>& evidence,
                                                    const ActiveSet& set) {
  Differing result{&candidate, 0.0, {}};
  std::vector<Estimates> others;
  for (std::size_t s = 0; s < evidence.size(); ++s) {
    if (!evidence[s]) continue;
    const Estimates alone = estimates_of(*evidence[s], set);
    if (has_no_sense(candidate, alone)) continue;
    FittedAlone one{fit.fit_takes[s].take->recording.name, alone.estimate, UnknownVector::Zero()};
    for (int u = 0; u < kUnknowns; ++u) one.deviation[u] = alone.deviation(u);
    result.alone.push_back(std::move(one));
    for (const Estimates& other : others) {
      const Estimates difference = less(alone, other);
      const double z = std::abs(significance(candidate, difference));
      if (z > std::max(result.z, kSignificanceOfFault) &&
          differs(candidate, difference, size_of(candidate, difference.estimate, fit.systems)))
        result.z = z;
    }
    others.push_back(alone);
  }
  return result.z > 0.0 ? std::optional(std::move(result)) : std::nullopt;
}

/// Whether takes no longer differ in a fault beside physics that one of them may have.
inline bool may_be_physics(const Candidate& fault, const Fit& fit, const Bank& bank,
                           const std::vector<std::optional<Evidence>>& evidence, const ActiveSet& set) {
  return std::ranges::any_of(bank, [&](const Candidate* law) {
    if (!is_law(*law) || is_in(set, *law)) return false;
    const ActiveSet beside = with(set, *law);
    const auto may_have = [&](const std::optional<Evidence>& take) {
      return take && in_favour(*law, significance(*law, estimates_of(*take, beside))) > kMayBe;
    };
    return std::ranges::any_of(evidence, may_have) && !difference_of_takes(fault, fit, evidence, beside);
  });
}

}  // namespace diagnose_detail

/// That of which several takes ask for different values, the surest first: of what is free in their fit, and
/// of physics that all of them together do not show.
template <class D>
std::vector<Differing> differing_takes(const Fit& fit, const Model& physics, const Bank& bank,
                                       const ActiveSet& set, int threads, const FitWatch& watch) {
  const std::vector<std::optional<Evidence>> evidence =
      diagnose_detail::evidence_alone<D>(fit, physics, set, threads, watch);
  std::vector<Differing> result;
  for (const Candidate* candidate : bank) {
    const bool free = is_in(set, *candidate), fault = candidate->kind == CandidateKind::kMeasurement;
    if (candidate->unknowns.empty() || (!free && !is_law(*candidate))) continue;
    std::optional<Differing> found =
        diagnose_detail::difference_of_takes(*candidate, fit, evidence, with(set, *candidate));
    if (found && !(fault && diagnose_detail::may_be_physics(*candidate, fit, bank, evidence, set)))
      result.push_back(std::move(*found));
  }
  std::ranges::stable_sort(result, std::greater(), &Differing::z);
  return result;
}

}  // namespace diabolo
