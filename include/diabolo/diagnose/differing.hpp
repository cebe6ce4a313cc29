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
std::vector<std::optional<Estimates>> estimates_alone(const Fit& fit, const Model& physics,
                                                      const ActiveSet& set, int threads,
                                                      const FitWatch& watch) {
  std::vector<std::optional<Estimates>> result(fit.fit_takes.size());
  for (std::size_t s = 0; s < fit.fit_takes.size(); ++s) {
    if (fit.fit_takes[s].windows.size() < kStretch) continue;
    const Fit alone = fitted_alone<D>(fit, s, physics, set, threads, watch);
    if (watch.is_enough()) return {};
    result[s] = estimates_of(Evidence(alone), set);
  }
  return result;
}

/// The two takes that differ most in something; nothing where none do.
inline std::optional<Differing> difference_of_takes(const Candidate& candidate, const Fit& fit,
                                                    const std::vector<std::optional<Estimates>>& alone) {
  Differing result{&candidate, 0.0, {}};
  for (std::size_t a = 0; a < alone.size(); ++a) {
    if (!alone[a]) continue;
    FittedAlone one{fit.fit_takes[a].take->recording.name, alone[a]->estimate, UnknownVector::Zero()};
    for (int u = 0; u < kUnknowns; ++u) one.deviation[u] = alone[a]->deviation(u);
    result.alone.push_back(std::move(one));
    for (std::size_t b = 0; b < a; ++b) {
      if (!alone[b]) continue;
      const Estimates difference = less(*alone[a], *alone[b]);
      const double z = std::abs(significance(candidate, difference));
      if (z > std::max(result.z, kSignificanceOfFault) &&
          differs(candidate, difference, size_of(candidate, difference.estimate, fit.systems)))
        result.z = z;
    }
  }
  return result.z > 0.0 ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace diagnose_detail

/// Of what is free in a fit to several takes, that of which they ask for different values, the surest first.
template <class D>
std::vector<Differing> differing_takes(const Fit& fit, const Model& physics, const Bank& bank,
                                       const ActiveSet& set, int threads, const FitWatch& watch) {
  const std::vector<std::optional<Estimates>> alone =
      diagnose_detail::estimates_alone<D>(fit, physics, set, threads, watch);
  std::vector<Differing> result;
  for (const Candidate* candidate : bank) {
    if (candidate->unknowns.empty() || !is_in(set, *candidate)) continue;
    std::optional<Differing> found = diagnose_detail::difference_of_takes(*candidate, fit, alone);
    if (found) result.push_back(std::move(*found));
  }
  std::ranges::stable_sort(result, std::greater(), &Differing::z);
  return result;
}

}  // namespace diabolo
