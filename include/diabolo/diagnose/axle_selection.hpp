// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "diabolo/diagnose/axle_fit.hpp"
#include "diabolo/diagnose/select.hpp"

namespace diabolo::diagnose_detail {

/// The one unknown of a law of the axle.
inline int number_of(const Candidate& law) { return index_of(law.unknowns.front()); }
inline bool is_gain(const Candidate& law) { return first_of(law) == Unknown::kGyroscopicGain; }
inline bool is_free(const AxleFit& fit, const Candidate& law) {
  return std::ranges::count(fit.free, number_of(law)) > 0;
}
inline double z_of(const Candidate& law, const UnknownVector& at, const UnknownVector& deviation) {
  const int u = number_of(law);
  return deviation[u] > 0.0 ? at[u] / deviation[u] : 0.0;
}

/// Whether it speaks for itself; of a law that the model has there may be less, too.
inline bool is_sure(const Candidate& law, double z, const Model& model) {
  return speaks_for(law, own_of_axle(model, number_of(law)) > 0.0 ? std::abs(z) : z);
}

/// All of them together. Without a gain no other law turns the axle, nor would anything be seen of it: where
/// the model has none, a usual one is where the fit begins.
inline AxleFit fit_all_axle_laws(const AxleStretches& stretches, const Model& model, const Bank& laws,
                                 int threads, const Watch& watch) {
  const int gain = index_of(Unknown::kGyroscopicGain);
  std::vector<int> free;
  UnknownVector at = UnknownVector::Zero();
  for (const Candidate* law : laws) free.push_back(number_of(*law));
  if (needs_gain(model) && std::ranges::count(free, gain) > 0)
    at[gain] = kUnknownInfos[static_cast<std::size_t>(gain)].scale;
  return fit_axle(stretches, model, free, at, threads, watch);
}

/// The least sure law of a fit, of those that do not speak for themselves; null where all do. A gain that
/// nothing works without is asked last.
inline const Candidate* weakest_of(const AxleFit& fit, const Model& model, const Bank& laws) {
  const UnknownVector deviation = fit.deviation();
  const Candidate* weakest = nullptr;
  double least = 0.0;
  for (const Candidate* law : laws) {
    const bool bears = is_gain(*law) && needs_gain(model) && fit.free.size() > 1;
    if (!is_free(fit, *law) || bears) continue;
    const double z = z_of(*law, fit.at, deviation);
    if (is_sure(*law, z, model) || (weakest != nullptr && std::abs(z) >= least)) continue;
    weakest = law;
    least = std::abs(z);
  }
  return weakest;
}

/// The fit of the others; nothing where none is left.
inline AxleFit without_law(const AxleFit& fit, const Candidate& law, const AxleStretches& stretches,
                           const Model& model, int threads, const Watch& watch) {
  std::vector<int> rest = fit.free;
  std::erase(rest, number_of(law));
  if (rest.empty() || (is_gain(law) && needs_gain(model))) return {};
  UnknownVector from = fit.at;
  from[number_of(law)] = 0.0;
  return fit_axle(stretches, model, rest, from, threads, watch);
}

/// Takes the least sure law out of a fit and fits the others again, until all that are left are sure.
inline AxleFit keep_sure_axle_laws(AxleFit fit, const AxleStretches& stretches, const Model& model,
                                   const Bank& laws, int threads, const Watch& watch) {
  while (const Candidate* const weakest = weakest_of(fit, model, laws))
    fit = without_law(fit, *weakest, stretches, model, threads, watch);
  return fit;
}

}  // namespace diabolo::diagnose_detail
