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
#include "diabolo/diagnose/calibration_words.hpp"
#include "diabolo/diagnose/differing_words.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/held_out_words.hpp"
#include "diabolo/diagnose/judge_adequacy.hpp"
#include "diabolo/diagnose/significance.hpp"

namespace diabolo {

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

/// Whether a candidate, or a law of somebody's own, is physics.
inline bool is_physics(const Diagnosis& d, std::string_view name) {
  const auto is_it = [&](const Candidate& candidate) {
    return candidate.name == name && candidate.kind == CandidateKind::kPhysics;
  };
  return std::ranges::any_of(candidates(), is_it) || (d.own && std::ranges::any_of(d.own->list, is_it));
}

/// What is tied with a claim: of a fault physics first.
inline const std::string& tie_of(const Diagnosis& d, const Finding& f) {
  const auto physics =
      std::ranges::find_if(f.tied_with, [&](const std::string& name) { return is_physics(d, name); });
  return physics != f.tied_with.end() ? *physics : f.tied_with.front();
}

/// Faults, each with what it may as well be: "a (or b or c) and d".
inline std::string plainly(const Diagnosis& d, const std::vector<const Finding*>& faults) {
  std::vector<std::string> names;
  for (const Finding* f : faults) {
    std::string text(f->candidate->plain);
    for (const std::string& other : f->tied_with)
      text += (&other == f->tied_with.data() ? " (or " : " or ") + plainly(d, other);
    names.push_back(text + (f->tied_with.empty() ? "" : ")"));
  }
  return listed(names);
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

/// How many times as fast a recording was played whose gravity seems stronger by that of a learnt law, which
/// is a constant force along it; nothing where the law is another, or so weak that it may well be one.
inline std::optional<double> speed_like(const Learnt& learnt) {
  constexpr double kLeast = 0.1;
  const std::string formula = learnt.law.formula.text();
  if (learnt.law.acts != Acts::kUp || (formula != "size" && formula != "size * taut")) return std::nullopt;
  const double speed = std::sqrt(std::max(0.0, 1.0 - learnt.value.front() / kStandardGravity));
  return speed > 0.0 && std::abs(speed - 1.0) > kLeast ? std::optional(speed) : std::nullopt;
}

/// A rate of the frames that is off acts as a constant force along gravity does: a sentence.
inline std::string force_like_rate_in_words(const Diagnosis& d) {
  for (const Learnt& learnt : d.learnt)
    if (const std::optional<double> speed = speed_like(learnt))
      return " A recording played " + three_digits(*speed) +
             " times as fast would look the same as that law: check its rate.";
  for (const Finding& f : d.findings) {
    const double down = f.estimate[index_of(Unknown::kGravity)];
    if (f.claimed && f.candidate->name == "frame_rate")
      return std::string(" A constant acceleration ") + (down > 0.0 ? "down" : "up") + " of " +
             size_in_words(std::abs(down), "m/s^2") + " would look the same as that rate.";
  }
  return {};
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
  const auto is_tied = [](const Finding* f) { return !f->tied_with.empty(); };
  auto tied = std::ranges::find_if(
      leading, [&](const Finding* f) { return is_tied(f) && is_physics(d, tie_of(d, *f)); });
  if (tied == leading.end()) tied = std::ranges::find_if(leading, is_tied);
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
    const std::string& other = tie_of(d, **tied);
    d.sentence =
        std::string(!physics.empty()       ? "Something is missing: "
                    : is_physics(d, other) ? "Something is missing, or measured wrongly: "
                                           : "The measurement is off: ") +
        plainly(leading) + " would explain it, and so would " + plainly(d, other) + " in place of " +
        std::string((*tied)->candidate->plain) + "; these recordings cannot tell" +
        (physics.empty() || faults.empty() ? "" : "; the measurement is off by " + plainly(d, faults)) +
        (has_law ? "; and a" + left_plainly(d) : ".");
  } else if (!physics.empty()) {
    d.headline = Headline::kNamed;
    d.sentence = "The simulator leaves out " + plainly(physics) +
                 (faults.empty() ? "" : "; the measurement is off by " + plainly(d, faults)) +
                 (has_law ? "; and a" + left_plainly(d) : ".");
  } else if (!faults.empty()) {
    d.headline = Headline::kMeasurementFault;
    d.sentence = "The measurement is off by " + plainly(d, faults) +
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
  if (leading.size() + d.learnt.size() > 0) d.sentence += worse_ahead_in_words(d.heldout);
  if (axle_leads || d.headline == Headline::kNothingMissing) d.sentence += calibration_in_words(d);
  if (d.reason.empty()) d.sentence += force_like_rate_in_words(d) + too_far_in_words(d);
  if (!axle_leads) d.sentence += axle_claims_behind(axle);
  d.sentence += axle_ahead_in_words(d.heldout.axle, !axle.empty());
  d.sentence += catch_in_words(d.catch_rule) + differing_in_words(d);
  for (std::size_t i = 0; i < d.not_done.size(); ++i)
    d.sentence += (i == 0 ? " Not done: " : "; ") + d.not_done[i] + (i + 1 == d.not_done.size() ? "." : "");
}

}  // namespace diabolo
