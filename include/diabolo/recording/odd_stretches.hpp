// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>

#include "diabolo/recording/recording.hpp"
#include "diabolo/recording/text.hpp"

namespace diabolo {

/// How far a body goes at least [m] while another one that rests to the last digit is thought to be frozen,
/// and in the step in which a frozen one comes free.
inline constexpr double kFrozenMove = 0.02;

/// Stretches of a recording of which the longest is told.
struct Stretches {
  double first = 0.0, length = 0.0;  ///< of the longest [s]
  double total = 0.0;                ///< of all [s]
  int count = 0;

  void add(double from, double to) {
    if (count++ == 0 || to - from > length) first = from, length = to - from;
    total += to - from;
  }
  /// "2.5 s, from 1.25 s on (the longest of 3 times)".
  std::string text() const {
    return rounded(length) + " s, from " + rounded(first) + " s on" +
           (count > 1 ? " (the longest of " + std::to_string(count) + " times)" : "");
  }
  static std::string rounded(double value) { return shown(std::round(value * 1e3) / 1e3); }
};

/// Times longer than `longest` [s] between two samples of a track that leave out rows.
inline Stretches unseen(const Track& track, const Eigen::VectorXd& time, double longest) {
  Stretches found;
  Eigen::Index seen = -1;
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    if (!track.valid[i]) continue;
    if (seen >= 0 && i > seen + 1 && time[i] - time[seen] > longest) found.add(time[seen], time[i]);
    seen = i;
  }
  return found;
}

/// Times between rows in which others should lie.
inline Stretches without_rows(const Recording& r) {
  Stretches found;
  for (Eigen::Index i = 0; i + 1 < r.size(); ++i)
    if ((r.time[i + 1] - r.time[i]) * r.rate > 1.5) found.add(r.time[i], r.time[i + 1]);
  return found;
}

/// Times longer than `longest` [s] for which a body does not move by a digit: it jumps before or after, or it
/// is the diabolo, and a tip goes elsewhere.
inline Stretches frozen(const Recording& r, const Track& track, double longest) {
  const auto jumps = [&track, &r](Eigen::Index i) {  // from row i to the next
    return i >= 0 && i + 1 < r.size() && track.valid[i] && track.valid[i + 1] && r.steps_evenly(i) &&
           (track.position.col(i + 1) - track.position.col(i)).norm() > kFrozenMove;
  };
  const auto moves = [](const Track& tip, Eigen::Index first, Eigen::Index last) {
    for (Eigen::Index k = first; k <= last; ++k)
      if (tip.valid[k] && tip.valid[first] &&
          (tip.position.col(k) - tip.position.col(first)).norm() > kFrozenMove)
        return true;
    return false;
  };
  Stretches found;
  for (Eigen::Index first = 0, i = 1; i <= r.size(); ++i) {
    if (i < r.size() && track.valid[i] && track.position.col(i) == track.position.col(first)) continue;
    const bool falls = &track == &r.diabolo;
    if (r.time[i - 1] - r.time[first] > longest &&
        (jumps(first - 1) || jumps(i - 1) ||
         (falls && (moves(r.left, first, i - 1) || moves(r.right, first, i - 1)))))
      found.add(r.time[first], r.time[i - 1]);
    first = i;
  }
  return found;
}

}  // namespace diabolo
