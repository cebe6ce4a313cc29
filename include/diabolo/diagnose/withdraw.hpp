// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diabolo/diagnose/corrected.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/judge_adequacy.hpp"
#include "diabolo/diagnose/left_out_says.hpp"
#include "diabolo/diagnose/significance.hpp"

// Claims that do not stand, and why.
namespace diabolo {

inline void claims_first(Diagnosis& d) {
  // (The algorithm on ranges returns a subrange, which Clang 14 cannot read in libstdc++ 12.)
  std::stable_partition(d.findings.begin(), d.findings.end(), [](const Finding& f) { return f.claimed; });
}

/// No fault is claimed that lies farther off than any measurement: something else is at work. (To be asked
/// once other explanations have been tried: a rate that is off by 4 % looks like a scale that is off by 8 %.)
inline void withdraw_what_cannot_be(Diagnosis& d) {
  for (Finding& f : d.findings) {
    if (!f.claimed || f.possible) continue;
    f.claimed = false;
    f.reason = "farther off than any measurement: something else is at work";
  }
  claims_first(d);
}

/// Physics that is left out since it is not sure, and would leave nothing sure of a fault: the surest of it;
/// null where there is none.
inline const Candidate* physics_instead(const Evidence& evidence, const Bank& bank, const ActiveSet& set,
                                        const Candidate& fault) {
  const Candidate* surest = nullptr;
  double most = kMayBe;
  for (const Candidate* other : bank) {
    if (!is_law(*other) || is_in(set, *other)) continue;
    const Estimates beside = estimates_of(evidence, with(set, *other));
    const double sure = in_favour(*other, significance(*other, beside));
    if (sure < most || (speaks_for(fault, significance(fault, beside)) && is_beyond_floor(fault, beside)))
      continue;
    surest = other;
    most = sure;
  }
  return surest;
}

/// A fault that may as well be physics is tied with it. (To be asked after exchange_claims(), which tries
/// others in the place of claims; and of all physics: that data left out deny it may be since the fault
/// stands in for it.)
inline void tie_with_physics(Diagnosis& d, const Evidence& evidence, const Bank& bank, const ActiveSet& set) {
  for (Finding& f : d.findings) {
    if (!f.claimed || f.candidate->kind != CandidateKind::kMeasurement) continue;
    const Candidate* other = physics_instead(evidence, bank, set, *f.candidate);
    if (other == nullptr || std::ranges::find(f.tied_with, other->name) != f.tied_with.end()) continue;
    f.tied_with.emplace_back(other->name);
    f.confidence = 0.5;
  }
}

/// Where nobody saw the spin, a tilt to the side is tied with friction, whatever fits: as long as the spin
/// keeps its sense, friction pushes to one side with the string's pull. (Fitted with a guessed spin, and
/// between noisy tips, it comes out too small.)
inline void tie_tilt_with_friction(Diagnosis& d) {
  const auto rubs = [](const Finding& f) { return f.claimed && f.candidate->name == "string_friction"; };
  if (std::ranges::any_of(d.findings, rubs)) return;
  for (Finding& f : d.findings) {
    if (!f.claimed || f.candidate->name != "gravity_tilt") continue;
    const double forward = f.estimate[index_of(Unknown::kTiltX)],
                 left = f.estimate[index_of(Unknown::kTiltY)];
    if (std::abs(left) < std::abs(forward) || std::ranges::count(f.tied_with, "string_friction") > 0)
      continue;
    f.tied_with.emplace_back("string_friction");
    f.confidence = 0.5;
  }
}

/// No string is claimed to be shorter than it was told that may as well be wrapped around the axle.
inline void withdraw_length_of_a_wrap(Diagnosis& d, const Estimates& now) {
  const auto wrapped = [](const Finding& f) {
    return f.claimed && std::ranges::find(f.tied_with, "string_wrap") != f.tied_with.end();
  };
  if (std::ranges::none_of(d.findings, wrapped)) return;
  if (!is_as_long_with_a_wrap(now)) return;
  for (Finding& f : d.findings) {
    if (!f.claimed || f.candidate->name != "string_length") continue;
    f.claimed = false;
    f.reason = "may as well be " + std::string(candidate_of("string_wrap").plain);
  }
  claims_first(d);
}

/// The least sure claim on the spin where what was left out shows a spin that is predicted worse than by the
/// base; null where there is none. The model has to do without it.
inline const Candidate* withdraw_spin_that_does_not_help(Diagnosis& d, const HeldOut& heldout) {
  Finding* weakest = nullptr;
  if (LeftOutSays(heldout.spin.improvement_ci95, kImmaterialSpin).against())
    for (Finding& f : d.findings)
      if (f.claimed && is_of_spin(*f.candidate) &&
          (weakest == nullptr || std::abs(f.z) < std::abs(weakest->z)))
        weakest = &f;
  if (weakest == nullptr) return nullptr;
  weakest->claimed = false;
  weakest->reason = kDenied;
  d.withdrawn = d.withdrawn || std::abs(weakest->z) > kStrong;
  return weakest->candidate;
}

/// Nothing stands, neither claims nor learnt laws, where held-out positions are predicted worse than by the
/// base. Returns whether that was so.
inline bool withdraw_what_does_not_help(Diagnosis& d, const HeldOut& heldout) {
  if (!LeftOutSays(heldout.position.improvement_ci95, kImmaterialPosition).against()) return false;
  for (Finding& f : d.findings) {
    if (!f.claimed) continue;
    f.claimed = false;
    d.withdrawn = d.withdrawn || (f.candidate->kind == CandidateKind::kPhysics && std::abs(f.z) > kStrong);
    f.reason = kDenied;
  }
  d.withdrawn = d.withdrawn || !d.learnt.empty();
  d.learnt.clear();
  return true;
}

/// Nothing is claimed that leaves the gap more than half open where the middle window still misses by far:
/// the motion is none that these laws make. Returns whether that was so. (Bodies under each other's names are
/// seen without a fit.)
inline bool withdraw_what_explains_too_little(Diagnosis& d) {
  const Adequacy& a = d.adequacy;
  if (a.overall.empty() || a.overall.front().quantity != "position" || !a.explained) return false;
  const auto ahead =
      static_cast<std::size_t>(std::ranges::find(d.heldout.horizons, kAhead) - d.heldout.horizons.begin());
  const std::optional<double> half =
      ahead < d.heldout.augmented_median.size() ? d.heldout.augmented_median[ahead] : std::nullopt;
  const bool far = a.overall.front().times_noise > kFarOff || half.value_or(0.0) > kFarOffAnyway;
  if (!far || *a.explained >= kHalfOpen || a.adequate.value_or(true)) return false;
  for (Finding& f : d.findings) {
    if (!f.claimed) continue;
    f.claimed = false;
    f.reason = "leaves more than half of the gap: the motion is none that the known laws make";
  }
  return true;
}

/// The base where no claim stands: with the rule for a catch that `physics` has, and with its laws that were
/// learnt, as they were fitted.
inline Model without_claims(const Model& base, const Model& physics, const UnknownVector& at,
                            const std::vector<Learnt>& learnt) {
  UnknownVector kept = UnknownVector::Zero();
  for (const Learnt& one : learnt)
    for (std::size_t i = 0; i < one.law.numbers.size(); ++i)
      kept[index_of(own_number(one.first + i))] = at[index_of(own_number(one.first + i))];
  Model result = base;
  result.parameters.catch_slack = physics.parameters.catch_slack;
  result.effects.get<FormulaLaws>() = fitted_laws(physics.effects.get<FormulaLaws>(), kept);
  return result;
}

/// Whether what was found is off by less than the base, in the mean, at most of the horizons.
inline bool is_nearer(const ErrorsByHorizon& errors) {
  std::size_t nearer = 0;
  for (std::size_t h = 0; h < errors.augmented_error.size(); ++h) {
    const auto &base = errors.base_error[h], &found = errors.augmented_error[h];
    nearer += base && found && *found < *base;
  }
  return 2 * nearer > errors.augmented_error.size();
}

/// No physics is claimed without which what was left out is surely predicted better, or rather better where
/// the spin does not say otherwise. Nor are tips somewhere else, unless it is predicted worse without at half
/// of the horizons that say anything, or, where none do, what was found is nearer than the base: six numbers
/// explain much that nobody knows. (Of other faults this is not asked: what one of them does, tips elsewhere
/// could do as well. What acts on the spin alone is judged by the spin.) Returns the least sure physics that
/// was withdrawn, which the model has to do without; null where there is none.
inline const Candidate* withdraw_what_left_out_data_deny(Diagnosis& d) {
  const Finding* weakest = nullptr;
  for (Finding& f : d.findings) {
    const LeftOutSays position(f.worsening_ci95, kImmaterialPosition),
        spin(f.spin_worsening_ci95, kImmaterialSpin), &says = is_of_spin(*f.candidate) ? spin : position;
    const bool physics = is_law(*f.candidate), tips = first_of(*f.candidate) == Unknown::kLeftX;
    const bool denied = physics ? says.against() || (says.leans_against() && spin.better == 0)
                                : tips && (says.horizons > 0 ? 2 * says.better < says.horizons
                                                             : !is_nearer(d.heldout.position));
    if (!f.claimed || !denied) continue;
    f.claimed = false;
    f.reason = says.horizons > 0 ? kDenied : kNotComparable;
    if (!physics) continue;
    d.withdrawn = d.withdrawn || (says.against() && std::abs(f.z) > kStrong);
    if (weakest == nullptr || std::abs(f.z) < std::abs(weakest->z)) weakest = &f;
  }
  const Candidate* result = weakest == nullptr ? nullptr : weakest->candidate;
  claims_first(d);
  return result;
}

/// The fault that would be sure without another one, in whose place it comes: the surest; null where there is
/// none.
inline const Candidate* fault_instead(const Evidence& evidence, const Bank& bank, const ActiveSet& set,
                                      const Candidate& fault) {
  const Estimates without = estimates_of(evidence, with(set, fault, false));
  const Candidate* surest = nullptr;
  double most = 0.0;
  for (const Candidate* other : bank) {
    if (other == &fault || other->kind != CandidateKind::kMeasurement || !is_in(set, *other)) continue;
    const double z = significance(*other, without), sure = in_favour(*other, z);
    if (!speaks_for(*other, z) || !is_beyond_floor(*other, without) || sure < most) continue;
    surest = other;
    most = sure;
  }
  return surest;
}

/// Where another fault takes the place of tips that are elsewhere, data that were left out cannot tell, and
/// deny nothing: the two are tied.
inline void tie_tips_with_faults(Diagnosis& d, const Evidence& evidence, const Bank& bank,
                                 const ActiveSet& set) {
  for (Finding& f : d.findings) {
    if (f.reason != kDenied || first_of(*f.candidate) != Unknown::kLeftX || !f.possible) continue;
    const Candidate* other = fault_instead(evidence, bank, set, *f.candidate);
    const auto stands = [&](const Finding& g) { return g.claimed && g.candidate == other; };
    if (other == nullptr || std::ranges::any_of(d.findings, stands)) continue;
    f.claimed = true;
    f.reason = kMaterial;
    f.tied_with = {std::string(other->name)};
    f.confidence = 0.5;
  }
  claims_first(d);
}

/// Of physics that left-out data denied before the last fit.
inline void say_denied(Diagnosis& d, const Candidate& candidate) {
  for (Finding& f : d.findings)
    if (f.candidate == &candidate && !f.claimed) f.reason = kDenied;
}

}  // namespace diabolo
