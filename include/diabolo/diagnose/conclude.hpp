// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diabolo/diagnose/adequacy_words.hpp"
#include "diabolo/diagnose/axle_words.hpp"
#include "diabolo/diagnose/differing_words.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/judge_adequacy.hpp"
#include "diabolo/diagnose/left_out_says.hpp"
#include "diabolo/diagnose/significance.hpp"

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

/// Physics that is left out since it is not sure, and would leave nothing sure of a fault; null where there
/// is none.
inline const Candidate* physics_instead(const Evidence& evidence, const Bank& bank, const ActiveSet& set,
                                        const Candidate& fault) {
  for (const Candidate* other : bank) {
    if (!is_law(*other) || is_in(set, *other)) continue;
    const Estimates beside = estimates_of(evidence, with(set, *other));
    const double z = significance(*other, beside);
    if ((other->positive ? z : std::abs(z)) < kMayBe) continue;
    if (!speaks_for(fault, significance(fault, beside)) || !is_beyond_floor(fault, beside)) return other;
  }
  return nullptr;
}

/// No fault is claimed that may as well be physics. (To be asked after exchange_claims(), which tries others
/// in the place of claims.)
inline void withdraw_what_may_be_physics(Diagnosis& d, const Evidence& evidence, const Bank& bank,
                                         const ActiveSet& set) {
  for (Finding& f : d.findings) {
    if (!f.claimed || f.candidate->kind != CandidateKind::kMeasurement) continue;
    const Candidate* other = physics_instead(evidence, bank, set, *f.candidate);
    if (other == nullptr) continue;
    f.claimed = false;
    f.reason = "may as well be " + std::string(other->plain);
  }
  claims_first(d);
}

/// No claim stands whose model predicts worse than the base what it was not fitted to: the spin, of a claim
/// on the spin; any, where positions are. Returns whether that was so.
inline bool withdraw_what_does_not_help(Diagnosis& d, const HeldOut& heldout) {
  const LeftOutSays position(heldout.position.improvement_ci95, kImmaterialPosition),
      spin(heldout.spin.improvement_ci95, kImmaterialSpin);
  if (!position.against() && !spin.against()) return false;
  bool withdrawn = false;
  for (Finding& f : d.findings) {
    if (!f.claimed || (!position.against() && !is_of_spin(*f.candidate))) continue;
    f.claimed = false;
    withdrawn = true;
    d.withdrawn = d.withdrawn || (f.candidate->kind == CandidateKind::kPhysics && std::abs(f.z) > kStrong);
    f.reason = kDenied;
  }
  return position.against() || withdrawn;
}

/// Nothing is claimed that leaves the gap more than half open where the middle window still misses by far:
/// the motion is none that these laws make. Returns whether that was so. (Bodies under each other's names are
/// seen without a fit.)
inline bool withdraw_what_explains_too_little(Diagnosis& d) {
  const Adequacy& a = d.adequacy;
  if (a.overall.empty() || a.overall.front().quantity != "position" || !a.explained) return false;
  const std::optional<double> half =
      d.heldout.augmented_median.size() > 2 ? d.heldout.augmented_median[2] : std::nullopt;
  const bool far = a.overall.front().times_noise > kFarOff || half.value_or(0.0) > kFarOffAnyway;
  if (!far || *a.explained >= kHalfOpen || a.adequate.value_or(true)) return false;
  for (Finding& f : d.findings) {
    if (!f.claimed) continue;
    f.claimed = false;
    f.reason = "leaves more than half of the gap: the motion is none that the known laws make";
  }
  return true;
}

/// No physics is claimed without which what was left out is surely predicted better, or rather better where
/// the spin does not say otherwise. Nor are tips somewhere else, unless it is predicted worse without at half
/// of the horizons, where that can be said: six numbers explain much that nobody knows. (Of other faults this
/// is not asked: what one of them does, tips elsewhere could do as well. What acts on the spin alone is
/// judged by the spin.) Returns the least sure physics that was withdrawn, which the model has to do without;
/// null where there is none.
inline const Candidate* withdraw_what_left_out_data_deny(Diagnosis& d) {
  const Finding* weakest = nullptr;
  for (Finding& f : d.findings) {
    const LeftOutSays position(f.worsening_ci95, kImmaterialPosition),
        spin(f.spin_worsening_ci95, kImmaterialSpin), &says = is_of_spin(*f.candidate) ? spin : position;
    const bool physics = is_law(*f.candidate), tips = first_of(*f.candidate) == Unknown::kLeftX;
    const bool denied = physics ? says.against() || (says.leans_against() && spin.better == 0)
                                : tips && 2 * says.better < says.horizons;
    if (!f.claimed || !denied) continue;
    f.claimed = false;
    f.reason = kDenied;
    if (!physics) continue;
    d.withdrawn = d.withdrawn || (says.against() && std::abs(f.z) > kStrong);
    if (weakest == nullptr || std::abs(f.z) < std::abs(weakest->z)) weakest = &f;
  }
  const Candidate* result = weakest == nullptr ? nullptr : weakest->candidate;
  claims_first(d);
  return result;
}

/// Of physics that left-out data denied before the last fit.
inline void say_denied(Diagnosis& d, const Candidate& candidate) {
  for (Finding& f : d.findings)
    if (f.candidate == &candidate && !f.claimed) f.reason = kDenied;
}

/// A candidate, or a law of somebody's own, in plain words.
inline std::string plainly(const Diagnosis& d, std::string_view name) {
  const auto is_it = [&](const Candidate& candidate) { return candidate.name == name; };
  if (const auto known = std::ranges::find_if(candidates(), is_it); known != candidates().end())
    return std::string(known->plain);
  if (d.own)
    if (const auto own = std::ranges::find_if(d.own->list, is_it); own != d.own->list.end())
      return std::string(own->plain);
  return std::string(name);
}

/// Where a latent acceleration acts.
inline std::string plainly(Unknown latent) {
  switch (latent) {
    case Unknown::kStringTangent:
      return "on the string, along it";
    case Unknown::kStringBinormal:
      return "on the string, across its plane";
    case Unknown::kFlightAgainst:
      return "in flight, against the velocity";
    case Unknown::kFlightVertical:
      return "in flight, upwards";
    default:
      return "in flight, square to axle and velocity";
  }
}

/// Of the force that has no name: the end of a sentence.
inline std::string left_plainly(const Diagnosis& d) {
  if (!d.learnt.empty()) {
    std::string text = " law that has no name is at work: ";
    for (std::size_t i = 0; i < d.learnt.size(); ++i)
      text += (i > 0 ? "; and " : "") + learnt_plainly(d.learnt[i]);
    return text + ". Held-out windows fit better with it.";
  }
  return " force that has no name is left: " + plainly(d.unexplained_forces.front().unknown) +
         "; no law of it was found that improves predictions of held-out data.";
}

/// Of faults that would have to be larger than they may be, where something stays unexplained: the end of the
/// sentence.
inline std::string too_far_in_words(const Diagnosis& d) {
  if (d.adequacy.adequate.value_or(true)) return {};
  for (const Finding& f : d.findings)
    if (!f.claimed && !f.possible && f.sure && std::abs(f.z) > kStrong)
      return " It is as if " + std::string(f.candidate->plain) +
             " were off by more than a measurement may be: check what was recorded.";
  return {};
}

/// A rate of the frames that is off acts as a constant force along gravity does: a sentence.
inline std::string force_like_rate_in_words(const Diagnosis& d) {
  for (const Finding& f : d.findings) {
    const double down = f.estimate[index_of(Unknown::kGravity)];
    if (f.claimed && f.candidate->name == "frame_rate")
      return std::string(" A constant acceleration ") + (down > 0.0 ? "down" : "up") + " of " +
             size_in_words(std::abs(down), "m/s^2") + " would look the same as that rate.";
  }
  return {};
}

/// Claims that the string is wrapped around the axle: at work wherever friction is.
inline void claim_wraps(Diagnosis& d, const Fit& fit, double z) {
  const auto friction = std::ranges::find_if(
      d.findings, [](const Finding& f) { return f.candidate->name == "string_friction"; });
  if (friction == d.findings.end() || !friction->claimed) return;
  Finding f = *friction;
  f.candidate = &candidate_of("string_wrap");
  f.estimate = fit.at;
  f.deviation.setZero();
  f.z = z;
  f.p_value = family_wise(z);
  f.claimed = f.material = true;
  f.confidence = friction->confidence;
  f.tied_with.clear();
  f.reason = "the string is as much shorter, and rubs as much more, as its turns around the axle make it";
  d.findings.insert(d.findings.begin(), f);
}

/// Headline and sentence. They are about place and spin: what turns the axle is named where nothing else is
/// found, and else said behind it.
inline void conclude(Diagnosis& d) {
  std::vector<const Finding*> physics, faults, axle;
  for (const Finding& f : d.findings)
    if (f.claimed)
      (f.candidate->kind != CandidateKind::kPhysics ? faults
       : is_of_axle(*f.candidate)                   ? axle
                                                    : physics)
          .push_back(&f);
  const std::vector<const Finding*>& leading = physics.empty() ? faults : physics;
  const auto tied = std::ranges::find_if(leading, [](const Finding* f) { return !f->tied_with.empty(); });
  const bool has_law = !d.learnt.empty();
  const bool only_leftover =
      !d.unexplained_forces.empty() && !d.withdrawn && d.unexplained <= kUnexplainedShare;
  const bool beyond_noise = !d.adequacy.adequate.value_or(true);
  bool axle_leads = false;
  if (!d.reason.empty()) {
    d.headline = Headline::kInsufficientData;
    d.sentence = "Nothing can be concluded: " + d.reason + ".";
  } else if (tied != leading.end()) {
    d.headline = Headline::kTie;
    d.sentence = std::string(physics.empty() ? "The measurement is off: " : "Something is missing: ") +
                 plainly(leading) + " would explain it, and so would " +
                 plainly(d, (*tied)->tied_with.front()) + " in place of " +
                 std::string((*tied)->candidate->plain) + "; these recordings cannot tell" +
                 (physics.empty() || faults.empty() ? "" : "; the measurement is off by " + plainly(faults)) +
                 (has_law ? "; and a" + left_plainly(d) : ".");
  } else if (!physics.empty()) {
    d.headline = Headline::kNamed;
    d.sentence = "The simulator leaves out " + plainly(physics) +
                 (faults.empty() ? "" : "; the measurement is off by " + plainly(faults)) +
                 (has_law ? "; and a" + left_plainly(d) : ".");
  } else if (!faults.empty()) {
    d.headline = Headline::kMeasurementFault;
    d.sentence = "The measurement is off by " + plainly(faults) +
                 (has_law        ? "; and a" + left_plainly(d)
                  : axle.empty() ? "; no physics that has a name is missing."
                                 : "; no other physics that has a name is missing.");
  } else if (d.numerical && *d.numerical > kNumericalShare && !has_law && !beyond_noise) {
    d.headline = Headline::kNumerical;
    d.sentence = std::string(axle.empty() ? "No" : "No other") +
                 " physics is missing: the numerical rules of " + d.base + " make the difference.";
  } else if (has_law || only_leftover) {
    d.headline = Headline::kUnnamedStructure;
    d.sentence = "A" + left_plainly(d);
  } else if (d.withdrawn) {
    d.headline = Headline::kUnnamedStructure;
    d.sentence = "Something is missing, but no explanation of it improves predictions of held-out data.";
  } else if (beyond_noise) {
    d.headline = Headline::kUnnamedStructure;
    d.sentence = "Something is missing that has no name.";
  } else if (d.unexplained > kUnexplainedShare) {
    d.headline = Headline::kUnnamedStructure;
    d.sentence = "Something without a name is left: " + std::to_string(std::lround(100.0 * d.unexplained)) +
                 " % of the windows are off by more than five times what the others are.";
  } else if (!axle.empty()) {
    d.headline = Headline::kNamed;
    d.sentence = "The simulator " + axle_claims_in_words(axle) + ".";
    axle_leads = true;
  } else {
    d.headline = Headline::kNothingMissing;
    d.sentence = d.catch_rule ? "No physics is missing that this recording could show."
                              : "Nothing is missing that this recording could show.";
  }
  const bool of_motion = leading.size() + d.learnt.size() > 0 || d.headline == Headline::kUnnamedStructure;
  if (d.reason.empty() && of_motion && d.headline != Headline::kNumerical)
    d.sentence += explained_in_words(d.adequacy, !physics.empty() || !faults.empty() || has_law);
  if (d.reason.empty()) d.sentence += force_like_rate_in_words(d) + too_far_in_words(d);
  if (!axle_leads) d.sentence += axle_claims_behind(axle);
  d.sentence += axle_ahead_in_words(d.heldout.axle, !axle.empty());
  d.sentence += catch_in_words(d.catch_rule);
  d.sentence += differing_in_words(d);
  for (std::size_t i = 0; i < d.not_done.size(); ++i)
    d.sentence += (i == 0 ? " Not done: " : "; ") + d.not_done[i] + (i + 1 == d.not_done.size() ? "." : "");
}

}  // namespace diabolo
