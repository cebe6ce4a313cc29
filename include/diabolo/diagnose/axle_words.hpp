// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diabolo/diagnose/adequacy_words.hpp"
#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// What is claimed, in plain words.
inline std::string plainly(const std::vector<const Finding*>& claims) {
  std::vector<std::string> names;
  names.reserve(claims.size());
  for (const Finding* f : claims) names.emplace_back(f->candidate->plain);
  return listed(names);
}

/// Whether a claim says that there is less of a law than the simulator has.
inline bool is_too_much(const Finding& f) {
  return f.candidate->positive && f.estimate[index_of(first_of(*f.candidate))] < 0.0;
}

/// What a simulator does with the laws of the axle that are claimed: "leaves out a and has too much of b".
inline std::string axle_claims_in_words(const std::vector<const Finding*>& claims) {
  std::vector<const Finding*> lacking, beyond;
  for (const Finding* f : claims) (is_too_much(*f) ? beyond : lacking).push_back(f);
  return (lacking.empty() ? "" : "leaves out " + plainly(lacking)) +
         (lacking.empty() || beyond.empty() ? "" : " and ") +
         (beyond.empty() ? "" : "has too much of " + plainly(beyond));
}

/// The same behind an answer that is about something else.
inline std::string axle_claims_behind(const std::vector<const Finding*>& claims) {
  for (const Finding* f : claims)
    if (is_too_much(*f))
      return " What turns the axle is off, too: the simulator " + axle_claims_in_words(claims) + ".";
  return claims.empty() ? "" : " What turns the axle is left out, too: " + plainly(claims) + ".";
}

/// How well the axle's direction is predicted where laws of it are claimed, and whether its strands had to
/// change.
inline std::string axle_ahead_in_words(const std::optional<AxleAhead>& ahead, bool claimed) {
  if (!ahead) return "";
  const auto degrees = [](double angle) { return size_in_words(angle / kDegree, "deg"); };
  std::string text;
  if (claimed)
    text += std::string(" On ") + (ahead->whole_recordings ? "held-out recordings" : "held-out stretches") +
            " this takes the axle's mean error after " + size_in_words(ahead->seconds, "s") + " from " +
            degrees(ahead->base_error) + " to " + degrees(ahead->augmented_error) +
            "; an axle of constant direction is off by " + degrees(ahead->constant_error) + ".";
  if (ahead->lets_strands_follow)
    text += " The simulator's strands do not follow the axle that it turns; the model's do (follows_axis).";
  return text;
}

}  // namespace diabolo
