// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <string>

#include "diabolo/recording/plausibility/regular_times.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Stretches of a recording of which the longest is told.
struct Stretches {
  double first = 0.0, length = 0.0;  ///< of the longest [s]
  int count = 0;

  void add(double from, double to) {
    if (count++ == 0 || to - from > length) first = from, length = to - from;
  }
  /// "2.5 s, from 1.25 s on (the longest of 3 times)".
  std::string text() const {
    return shown_rounded(length) + " s, from " + shown_rounded(first) + " s on" +
           (count > 1 ? " (the longest of " + std::to_string(count) + " times)" : "");
  }
};

/// Times longer than `longest` [s] between two samples of a track, or after the last one, that leave out
/// rows.
inline Stretches unseen(const Track& track, const Eigen::VectorXd& time, double longest) {
  Stretches found;
  Eigen::Index seen = -1;
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    if (!track.valid[i] && i + 1 < time.size()) continue;
    const bool leaves_out = i > seen + 1 || !track.valid[i];
    if (seen >= 0 && leaves_out && time[i] - time[seen] > longest) found.add(time[seen], time[i]);
    seen = i;
  }
  return found;
}

/// Times between rows in which others should lie, and how many.
struct MissingRows {
  Stretches stretches;
  double share = 0.0;  ///< of all rows that should be there

  explicit MissingRows(const Recording& r) {
    double missing = 0.0;
    for (Eigen::Index i = 0; i + 1 < r.size(); ++i) {
      const double periods = (r.time[i + 1] - r.time[i]) * r.rate;
      if (periods <= kGapInPeriods) continue;
      stretches.add(r.time[i], r.time[i + 1]);
      missing += periods - 1.0;
    }
    share = missing / (missing + static_cast<double>(std::max<Eigen::Index>(1, r.size())));
  }
};

/// Calls visit(first, last) with the rows of each stretch in which a track repeats its position to the last
/// digit, one after the other; a dropout, and a row that none repeats, is one of its own.
template <class Visit>
void for_each_rest(const Track& track, const Visit& visit) {
  const Eigen::Index size = track.valid.size();
  for (Eigen::Index first = 0, next = 1; first < size; first = next++) {
    while (next < size && track.valid[next] && track.position.col(next) == track.position.col(first)) ++next;
    visit(first, next - 1);
  }
}

/// How far a frozen body jumps at least [m], and how many times farther than it goes in the row beside; and
/// how far a tip goes at least while a diabolo that rests to the last digit is thought to be frozen.
inline constexpr double kFrozenJump = 0.02, kJumpOverStep = 3.0;

/// Times longer than `longest` [s] for which a track does not move by a digit, though it jumps before or
/// after, or one of the tips that it hangs on goes elsewhere (`tips`; null where it hangs on none).
inline Stretches frozen(const Recording& r, const Track& track, double longest,
                        const Track* const (&tips)[2]) {
  const auto step = [&](Eigen::Index i) {  // from row i to the next [m]; none: 0
    return i >= 0 && i + 1 < r.size() && track.valid[i] && track.valid[i + 1] && r.steps_evenly(i)
               ? (track.position.col(i + 1) - track.position.col(i)).norm()
               : 0.0;
  };
  const auto jumps = [&](Eigen::Index i, Eigen::Index beside) {
    return step(beside) > 0.0 && step(i) > std::max(kFrozenJump, kJumpOverStep * step(beside));
  };
  const auto moves = [](const Track* tip, Eigen::Index first, Eigen::Index last) {
    while (tip != nullptr && first < last && !tip->valid[first]) ++first;
    for (Eigen::Index k = first; tip != nullptr && k <= last; ++k)
      if (tip->valid[k] && (tip->position.col(k) - tip->position.col(first)).norm() > kFrozenJump)
        return true;
    return false;
  };
  Stretches found;
  for_each_rest(track, [&](Eigen::Index first, Eigen::Index last) {
    if (r.time[last] - r.time[first] > longest &&
        (jumps(first - 1, first - 2) || jumps(last, last + 1) || moves(tips[0], first, last) ||
         moves(tips[1], first, last)))
      found.add(r.time[first], r.time[last]);
  });
  return found;
}

}  // namespace diabolo
