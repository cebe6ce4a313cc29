// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/diagnose/inquiry.hpp"
#include "diabolo/recording/plausibility/reversed_time.hpp"
#include "diabolo/recording/plausibility/swapped_bodies.hpp"

namespace diabolo {

namespace diagnose_detail {

/// How recordings may have to be read in which friction gives energy.
enum class Reading { kSticksExchanged, kTimeReversed };

/// An answer to recordings that were read otherwise than given.
struct OtherReading {
  Reading reading;
  Diagnosis answer;
};

/// Whether the middle error on held-out data is at most `factor` times another's at the last horizon that
/// both reach; not where they reach none.
inline bool predicts_within(double factor, const Diagnosis& one, const Diagnosis& other) {
  const auto &ours = one.heldout.augmented_median, &theirs = other.heldout.augmented_median;
  for (std::size_t h = std::min(ours.size(), theirs.size()); h-- > 0;)
    if (ours[h] && theirs[h]) return *ours[h] <= factor * *theirs[h];
  return false;
}

/// The answer to recordings that are read so, if friction takes energy then.
template <class D>
std::optional<OtherReading> answer_as(Reading reading, std::vector<Recording> recordings,
                                      DiagnosisOptions options, const DiagnosisWatch& watch, double seconds) {
  for (std::vector<Recording>* list : {&recordings, &options.holdout})
    for (Recording& recording : *list)
      recording = reading == Reading::kSticksExchanged ? with_sticks_exchanged(std::move(recording))
                                                       : with_time_reversed(std::move(recording));
  Inquiry<D> inquiry(recordings, options, watch, seconds);
  Diagnosis answer = inquiry.answer();
  const bool rubs = std::ranges::any_of(
      answer.findings, [](const Finding& f) { return f.claimed && f.candidate->name == "string_friction"; });
  if (!rubs || inquiry.backwards()) return std::nullopt;
  return OtherReading{reading, std::move(answer)};
}

/// Where friction gives energy in recordings `as_given`: the reading under which it takes some, of two the
/// one that predicts better. Sticks are exchanged where nobody sees which is which. In reversed time
/// predictions must be no worse than as given, which something else that gives energy would make them. Notes
/// what there was no time to ask.
template <class D>
std::optional<OtherReading> other_reading(Diagnosis& as_given, bool sticks_are_known,
                                          const std::vector<Recording>& recordings,
                                          const DiagnosisOptions& options, const DiagnosisWatch& watch,
                                          const TimeBudget& budget) {
  constexpr double kNoWorse = 1.1;
  std::optional<OtherReading> exchanged, reversed;
  if (!sticks_are_known && !budget.spent())
    exchanged = answer_as<D>(Reading::kSticksExchanged, recordings, options, watch,
                             options.budget - budget.elapsed());
  if (!budget.spent())
    reversed =
        answer_as<D>(Reading::kTimeReversed, recordings, options, watch, options.budget - budget.elapsed());
  if (budget.spent()) {
    const std::string left =
        TimeBudget::beyond("asking whether sticks are exchanged, or time runs backwards");
    as_given.not_done.emplace_back(left);
    conclude(as_given);
    if (exchanged) {
      exchanged->answer.not_done.emplace_back(left);
      conclude(exchanged->answer);
    }
    return exchanged;
  }
  if (reversed && !predicts_within(kNoWorse, reversed->answer, as_given)) reversed.reset();
  if (!exchanged || !reversed) return exchanged ? std::move(exchanged) : std::move(reversed);
  return predicts_within(1.0, exchanged->answer, reversed->answer) ? std::move(exchanged)
                                                                   : std::move(reversed);
}

/// Nothing is said of a play that runs backwards.
inline Diagnosis refused_as_reversed(const Diagnosis& as_given, const DiagnosisOptions& options) {
  Diagnosis d;
  d.base = as_given.base;
  d.base_gravity = as_given.base_gravity;
  d.base_string_length = as_given.base_string_length;
  d.windows_seen = as_given.windows_seen;
  d.own = as_given.own;
  d.model = options.base;
  d.not_done = as_given.not_done;
  d.reason =
      "time seems to run backwards: the string's friction gives energy, and takes it where the rows are read "
      "from the last to the first";
  conclude(d);
  return d;
}

}  // namespace diagnose_detail

}  // namespace diabolo
