// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "diabolo/diagnose/findings.hpp"

namespace diabolo {

namespace diagnose_detail {

/// Whether a fault is fitted along and not claimed.
inline bool is_fitted_along(const Finding& f, const ActiveSet& set) {
  return f.candidate->kind == CandidateKind::kMeasurement && !f.claimed && f.possible &&
         is_in(set, *f.candidate) && is_nuisance(*f.candidate);
}

/// What is fitted along is off by its floor, as any measurement may be, but for one fault.
inline UnknownVector priors_within_floors(const std::vector<Finding>& findings, const ActiveSet& set,
                                          const Candidate* but) {
  UnknownVector result = prior_precision();
  for (const Finding& f : findings) {
    if (!is_fitted_along(f, set) || f.candidate == but) continue;
    for (const Unknown u : f.candidate->unknowns)
      result[index_of(u)] = std::max(result[index_of(u)], std::pow(info_of(u).scale / f.candidate->floor, 2));
  }
  return result;
}

/// A fault as it stands where all others are within their floors.
struct LoneFault {
  Finding* finding;
  Estimates standing;
  double z;  ///< that it is needed
};

inline void claim(const LoneFault& lone) {
  Finding& f = *lone.finding;
  f.z = lone.z;
  f.p_value = family_wise(f.z);
  for (const Unknown u : f.candidate->unknowns) {
    f.estimate[index_of(u)] = lone.standing.estimate[index_of(u)];
    f.deviation[index_of(u)] = lone.standing.deviation(index_of(u));
  }
  f.sure = f.material = f.claimed = true;
  f.reason = kMaterial;
}

}  // namespace diagnose_detail

/// Several faults may share what one of them does, and none of them be sure: a string of another length, the
/// scale of lengths and the height of the tips. Where a single one beyond its floor explains as much, all
/// others within theirs, and much is left without any, it is claimed. Others that do as well are tied.
inline void claim_lone_fault(Diagnosis& d, const Evidence& evidence, const ActiveSet& set) {
  using diagnose_detail::is_fitted_along;
  const auto within_floors = [&](const Candidate* but) {
    return evidence.with_priors(diagnose_detail::priors_within_floors(d.findings, set, but));
  };
  int numbers = 0;  // each costs one dispersion where it is off by its floor
  for (const Finding& f : d.findings)
    if (is_fitted_along(f, set)) numbers += static_cast<int>(f.candidate->unknowns.size());
  const double as_good = evidence.cost(set) + (kAsGood + numbers) * evidence.dispersion(),
               without_any = within_floors(nullptr).cost(set);
  std::vector<diagnose_detail::LoneFault> lone;
  for (Finding& f : d.findings) {
    if (!is_fitted_along(f, set)) continue;
    const Evidence alone = within_floors(f.candidate);
    const Estimates standing = estimates_of(alone, set);
    const double z = std::sqrt(std::max(0.0, without_any - alone.cost(set)) / evidence.dispersion());
    if (alone.cost(set) < as_good && z > kSignificanceOfFault && is_beyond_floor(*f.candidate, standing) &&
        is_possible(*f.candidate, standing))
      lone.push_back({&f, standing, z});
  }
  if (lone.empty()) return;
  std::ranges::stable_sort(lone, std::greater(), &diagnose_detail::LoneFault::z);
  diagnose_detail::claim(lone.front());
  Finding& best = *lone.front().finding;
  for (std::size_t i = 1; i < lone.size(); ++i) best.tied_with.emplace_back(lone[i].finding->candidate->name);
  best.confidence = best.tied_with.empty() ? confidence_of(best.z) : 0.5;
  surest_first(d.findings);
}

}  // namespace diabolo
