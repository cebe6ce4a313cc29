// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
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

/// How far predictions of data left out are off at the last horizon that any of them reaches [m].
inline double error_ahead(const Diagnosis& d) {
  const std::vector<std::optional<double>>& errors = d.heldout.position.augmented_error;
  for (std::size_t h = errors.size(); h-- > 0;)
    if (errors[h]) return *errors[h];
  return std::numeric_limits<double>::infinity();
}

/// The answer to recordings that are read so, if friction takes energy then.
template <class D>
std::optional<OtherReading> read_as(Reading reading, std::vector<Recording> recordings,
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

/// Where friction gives energy in recordings `as_given`: the reading under which it takes some, of several
/// the one that predicts best. Sticks are exchanged where nobody sees which is which. In reversed time
/// predictions must be no worse than as given, which something else that gives energy would make them.
template <class D>
std::optional<OtherReading> other_reading(const Diagnosis& as_given, bool sticks_are_known,
                                          const std::vector<Recording>& recordings,
                                          const DiagnosisOptions& options, const DiagnosisWatch& watch,
                                          const TimeBudget& budget) {
  constexpr double kNoWorse = 1.1;
  std::optional<OtherReading> best;
  for (const Reading reading : {Reading::kSticksExchanged, Reading::kTimeReversed}) {
    if ((reading == Reading::kSticksExchanged && sticks_are_known) || budget.spent()) continue;
    std::optional<OtherReading> other =
        read_as<D>(reading, recordings, options, watch, options.budget - budget.elapsed());
    if (!other) continue;
    const double error = error_ahead(other->answer);
    if (reading == Reading::kTimeReversed && error > kNoWorse * error_ahead(as_given)) continue;
    if (!best || error < error_ahead(best->answer)) best = std::move(other);
  }
  return best;
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
  d.reason =
      "time seems to run backwards: the string's friction gives energy, and takes it where the rows are read "
      "from "
      "the last to the first";
  conclude(d);
  return d;
}

}  // namespace diagnose_detail

}  // namespace diabolo
