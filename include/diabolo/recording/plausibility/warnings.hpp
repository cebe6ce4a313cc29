// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "diabolo/recording/plausibility/fall.hpp"
#include "diabolo/recording/plausibility/frozen_tracks.hpp"
#include "diabolo/recording/plausibility/odd_match.hpp"
#include "diabolo/recording/plausibility/odd_orientations.hpp"
#include "diabolo/recording/plausibility/odd_spin.hpp"
#include "diabolo/recording/plausibility/odd_stretches.hpp"
#include "diabolo/recording/plausibility/odd_tips.hpp"
#include "diabolo/recording/plausibility/odd_tracking.hpp"
#include "diabolo/recording/plausibility/regular_times.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Longest time [s] for which a tip may be unseen: half a beat of a player's hands, more than which no curve
/// through what was seen before and after can make up for.
inline constexpr double kLongestUnseen = 0.25;

/// Longest time without rows [s] (beyond one period), and the largest share of rows that may be missing.
inline constexpr double kLongestWithoutRows = 0.1, kMostMissingRows = 0.05;

/// What of the set-up is assumed; empty where all of it was told.
inline std::string assumed_setup(const Recording& recording) {
  std::string what;
  for (const std::string& name : recording.assumed)
    what += (what.empty() ? "" : " and ") +
            (name == "diabolo" ? "the diabolo (" + shown(recording.properties.mass) + " kg)"
                               : "the string's length (" + shown(recording.string_length) + " m)");
  const bool is_one = recording.assumed.size() == 1;
  return what.empty() ? what
                      : what + (is_one ? " is" : " are") +
                            " assumed: no file, calibration or argument tells " + (is_one ? "it" : "them");
}

/// What its reader changed in a recording, and what is odd about it although it is well formed: each a clause
/// that says what is found and what it means. Whatever is computed from such a recording deserves a second
/// look.
inline std::vector<std::string> warnings(const Recording& recording) {
  std::vector<std::string> result = recording.notes;
  const auto is_odd = [&result](std::string clause) {
    if (clause.empty()) return false;
    result.push_back(std::move(clause));
    return true;
  };
  // One cause, one clause: what follows from another oddity is not told as well.
  const std::vector<Fall> fallen = falls(recording);
  is_odd(assumed_setup(recording));
  is_odd(odd_times(recording));
  if (!is_odd(odd_still_tips(recording, fallen)) && !is_odd(odd_path_length(recording)) &&
      !is_odd(odd_distance(recording)) && !is_odd(odd_up(recording, fallen)) &&
      !is_odd(odd_height(recording)) && !is_odd(odd_shift(recording)) && !is_odd(odd_axes(recording)))
    is_odd(odd_fall(recording, fallen));
  if (!is_odd(odd_orientations(recording))) is_odd(open_spin(recording));
  is_odd(odd_heading(recording));
  is_odd(odd_names(recording));
  const Track* const tips[2] = {&recording.left, &recording.right};
  const Track* const none[2] = {nullptr, nullptr};
  for (const auto& [side, tip] : {std::pair{"left", tips[0]}, std::pair{"right", tips[1]}})
    if (recording.size() > 0 && !tip->valid.any())
      result.push_back(std::string("the ") + side + " tip is never seen; nothing can be predicted");
    else if (const Stretches gap = unseen(*tip, recording.time, kLongestUnseen); gap.count > 0)
      result.push_back(std::string("the ") + side + " tip is not seen for " + gap.text() +
                       "; a prediction across it goes by a guess");
  if (recording.size() > 0 && !recording.diabolo.valid.any())
    result.emplace_back("the diabolo is never seen; nothing can be compared");
  if (const MissingRows missing(recording);
      missing.stretches.length > kLongestWithoutRows + 1.0 / recording.rate ||
      missing.share > kMostMissingRows)
    result.push_back(std::to_string(std::lround(100.0 * missing.share)) +
                     " % of the rows are missing: none for " + missing.stretches.text());
  for (const auto& [name, track, hangs_on] :
       {std::tuple{"left tip", tips[0], &none}, std::tuple{"right tip", tips[1], &none},
        std::tuple{"diabolo", &recording.diabolo, &tips}})
    if (const Stretches rest = frozen(recording, *track, kLongestRest, *hangs_on); rest.count > 0)
      result.push_back(std::string("the ") + name + " does not move by a digit for " + rest.text() +
                       ": frozen tracking");
  return result;
}

}  // namespace diabolo
