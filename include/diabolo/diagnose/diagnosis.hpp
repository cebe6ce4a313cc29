// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/inquiry.hpp"
#include "diabolo/diagnose/other_reading.hpp"
#include "diabolo/recording/plausibility/odd_orientations.hpp"
#include "diabolo/recording/plausibility/odd_tips.hpp"
#include "diabolo/recording/plausibility/odd_tracking.hpp"
#include "diabolo/recording/plausibility/swapped_bodies.hpp"

namespace diabolo {

namespace diagnose_detail {

/// Claims that bodies were recorded under each other's names in so many frames.
inline void claim_swap(Diagnosis& d, long frames, const std::string& reason) {
  Finding f;
  f.candidate = &candidate_of("body_swap");
  f.p_value = 0.0;
  f.claimed = f.material = true;
  f.confidence = 0.99;
  f.swapped = frames;
  f.reason = reason;
  d.findings.insert(d.findings.begin(), f);
  conclude(d);
}

}  // namespace diagnose_detail

template <class D>
Diagnosis diagnose(std::vector<Recording> recordings, DiagnosisOptions options, const DiagnosisWatch& watch) {
  if (recordings.empty()) throw std::invalid_argument("recordings: none; at least one expected");
  check_threads(options.threads);
  long swapped = 0, frames = 0;
  std::string places;
  bool sticks_are_known = true, sides_are_wrong = false, seen_by_tips = false;
  for (std::vector<Recording>* list : {&recordings, &options.holdout})
    for (Recording& recording : *list) {
      const Swaps swaps = unswap(recording);
      mask_odd_orientations(recording);
      const long jumped = static_cast<long>(swaps.count), rows = static_cast<long>(recording.size());
      const std::optional<int> off = quarters_off(recording);
      const std::optional<bool> seen = sticks_are_exchanged(recording);
      // (Where the tips lie as they should, directions that say otherwise may be of the sticks' other ends.)
      const bool by_tips = off == 2 && !seen.value_or(false),
                 exchanged = by_tips || (off != 0 && seen.value_or(false)),
                 known = by_tips || seen.value_or(!exchanged) == exchanged;
      if (exchanged) recording = with_sticks_exchanged(std::move(recording));
      if (list != &recordings) continue;
      seen_by_tips = seen_by_tips || by_tips;
      sticks_are_known = sticks_are_known && known;
      sides_are_wrong = sides_are_wrong || exchanged;
      swapped += exchanged ? rows - jumped : jumped;
      frames += rows;
      if (swaps.count > 0) places += "; in " + recording.name + " from " + times_of(swaps, recording.time);
    }
  const TimeBudget budget(options.budget, watch.clock);
  diagnose_detail::Inquiry<D> inquiry(recordings, options, watch, options.budget);
  Diagnosis result = inquiry.answer();
  bool by_friction = false;
  if (inquiry.backwards()) {
    auto other =
        diagnose_detail::other_reading<D>(result, sticks_are_known, recordings, options, watch, budget);
    if (other && other->reading == diagnose_detail::Reading::kTimeReversed)
      result = diagnose_detail::refused_as_reversed(result, options);
    else if (other)
      result = std::move(other->answer);
    by_friction = other && other->reading == diagnose_detail::Reading::kSticksExchanged;
  }
  if (by_friction) swapped = frames - swapped;
  const std::string reason = by_friction ? "friction would give energy unless the sticks are exchanged"
                             : seen_by_tips
                                 ? "the left tip is on the right: exchanged sticks, or a frame that "
                                   "is turned by 180 degrees about the vertical"
                             : sides_are_wrong ? "seen along the sticks, the left one is on the right"
                                               : "bodies jump to each other's places and back" + places;
  const bool asked = options.bank.empty() || std::ranges::count(options.bank, "body_swap") > 0;
  if (swapped > 0 && asked && result.reason.empty()) diagnose_detail::claim_swap(result, swapped, reason);
  if (watch.progress) watch.progress("done", 1.0);
  return result;
}

}  // namespace diabolo
