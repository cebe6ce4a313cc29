// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/recording/recording.hpp"
#include "diabolo/recording/text.hpp"
#include "diabolo/recording/tip_motion.hpp"
#include "diabolo/recording/usual_path.hpp"
#include "diabolo/recording/windows.hpp"

namespace diabolo {

/// Longest time [s] for which a tracked diabolo may seem to rest to the last digit beside moving sticks.
inline constexpr double kLongestRest = 0.1;

/// Longest time [s] for which a tip may be unseen: half a beat of a player's hands, more than which no curve
/// through what was seen before and after can make up for.
inline constexpr double kLongestUnseen = 0.25;

/// How far a tip goes at least while a diabolo that seems to rest is thought to be frozen [m].
inline constexpr double kMovedTip = 0.02;

namespace detail {

/// The longest of some stretches of rows, and how many there are.
struct LongStretch {
  Eigen::Index first = 0, last = 0;  ///< rows at its ends
  int count = 0;

  void add(Eigen::Index from, Eigen::Index to, const Eigen::VectorXd& times) {
    if (count++ == 0 || times[to] - times[from] > times[last] - times[first]) first = from, last = to;
  }
  /// "2.5 s, from 1.25 s on (the longest of 3 times)".
  std::string text(const Recording& r) const {
    const auto rounded = [](double seconds) { return shown(std::round(seconds * 1e3) / 1e3); };
    return rounded(r.time[last] - r.time[first]) + " s, from " + rounded(r.time[first]) + " s on" +
           (count > 1 ? " (the longest of " + std::to_string(count) + " times)" : "");
  }
};

/// Times for which a tip is missing; see in_long_gap().
inline LongStretch unseen(const Track& tip, const Eigen::VectorXd& times) {
  const std::vector<bool> gaps = in_long_gap(tip, times);
  LongStretch found;
  for (Eigen::Index i = 0; i + 1 < times.size(); ++i) {
    const Eigen::Index first = i;
    while (i + 1 < times.size() && gaps[static_cast<std::size_t>(i)]) ++i;
    const bool missing = !tip.valid.segment(first, i - first + 1).all();
    if (missing && times[i] - times[first] > kLongestUnseen) found.add(first, i, times);
  }
  return found;
}

/// Times for which the diabolo does not move by a digit while a tip does.
inline LongStretch frozen(const Recording& r) {
  LongStretch found;
  for (Eigen::Index first = 0, i = 1; i <= r.size(); ++i) {
    if (i < r.size() && r.diabolo.valid[i] && r.diabolo.position.col(i) == r.diabolo.position.col(first))
      continue;
    const Eigen::Index n = i - first;
    const auto moved = [&](const Track& tip) {
      double farthest = 0.0;
      for (Eigen::Index k = first; k < i; ++k)
        if (tip.valid[k] && tip.valid[first])
          farthest = std::max(farthest, (tip.position.col(k) - tip.position.col(first)).norm());
      return farthest > kMovedTip;
    };
    if (n > 1 && r.time[i - 1] - r.time[first] > kLongestRest && (moved(r.left) || moved(r.right)))
      found.add(first, i - 1, r.time);
    first = i;
  }
  return found;
}

}  // namespace detail

/// What is odd about a recording that is well formed: each a clause that says what is found and what it
/// means. Whatever is computed from such a recording deserves a second look.
inline std::vector<std::string> warnings(const Recording& recording) {
  std::vector<std::string> result;
  if (std::string path = odd_path_length(recording); !path.empty()) result.push_back(std::move(path));
  for (const auto& [side, tip] : {std::pair{"left", &recording.left}, std::pair{"right", &recording.right}})
    if (const auto gap = detail::unseen(*tip, recording.time); gap.count > 0)
      result.push_back(std::string("the ") + side + " tip is not seen for " + gap.text(recording) +
                       "; a prediction across it goes by a guess");
  detail::LongStretch jump;
  for (Eigen::Index i = 0; i + 1 < recording.size(); ++i)
    if (recording.time[i + 1] - recording.time[i] > kLongestTipGap) jump.add(i, i + 1, recording.time);
  if (jump.count > 0) result.push_back("there are no rows for " + jump.text(recording));
  if (const auto rest = detail::frozen(recording); rest.count > 0)
    result.push_back("the diabolo does not move by a digit for " + rest.text(recording) +
                     ", while the sticks do: frozen tracking");
  return result;
}

}  // namespace diabolo
