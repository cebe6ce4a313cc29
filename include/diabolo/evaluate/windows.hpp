// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "diabolo/evaluate/start_state.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/recording/tip_motion.hpp"

namespace diabolo {

/// A start and the rows at which a prediction from there can be compared.
struct PredictionWindow {
  Eigen::Index start;
  std::vector<std::optional<Eigen::Index>> rows;  ///< for each horizon; none where it cannot be compared
  Eigen::Index last;                              ///< the latest of the rows
};

/// Longest gap in a tip's track [s] that a prediction may run over.
inline constexpr double kLongestTipGap = 0.1;

/// Marks the rows i for which a tip is not known well between rows i and i + 1: the time from its last sample
/// at or before i to its next one is longer than kLongestTipGap.
inline std::vector<bool> in_long_gap(const Track& tip, const Eigen::VectorXd& times) {
  const Eigen::Index size = times.size();
  std::vector<bool> marks(static_cast<std::size_t>(size), true);
  Eigen::Index seen = -1;
  for (Eigen::Index i = 0; i < size; ++i) {
    if (!tip.valid[i]) continue;
    if (seen >= 0 && times[i] - times[seen] <= kLongestTipGap + kSameInstant)
      std::fill(marks.begin() + seen, marks.begin() + i, false);
    seen = i;
  }
  return marks;
}

/// The windows of a recording, the same for every model. A start is every row a multiple of `starts_every`
/// [s] after row 0 at which both kinds of Start are known; a horizon [s] can be compared where the diabolo is
/// seen in the row nearest to it (the earlier of two), at most half a period off, and no tip has a long gap
/// from start to there.
inline std::vector<PredictionWindow> prediction_windows(const Recording& recording, const StartStates& starts,
                                                        const Eigen::VectorXd& times, double starts_every,
                                                        const std::vector<double>& horizons) {
  const Eigen::Index size = recording.size();
  const std::vector<bool> left = in_long_gap(recording.left, times),
                          right = in_long_gap(recording.right, times);
  std::vector<Eigen::Index> gaps(static_cast<std::size_t>(size) + 1,
                                 0);  // rows in a long gap, up to each row
  for (std::size_t i = 0; i < left.size(); ++i) gaps[i + 1] = gaps[i] + (left[i] || right[i] ? 1 : 0);
  const auto nearest = [&](double time) {
    const double* const begin = times.data();
    const Eigen::Index after = std::lower_bound(begin, begin + size, time) - begin;
    return after == size || (after > 0 && time - times[after - 1] <= times[after] - time + kSameInstant)
               ? after - 1
               : after;
  };

  std::vector<PredictionWindow> windows;
  Eigen::Index previous = -1;
  for (double k = 0.0; size > 0 && k * starts_every <= times[size - 1]; k += 1.0) {
    const Eigen::Index start = nearest(k * starts_every);
    if (start == previous) continue;
    previous = start;
    if (!starts.known(Start::kFair, start) || !starts.known(Start::kPublished, start)) continue;
    PredictionWindow window{start, {}, start};
    for (const double horizon : horizons) {
      const Eigen::Index row = nearest(times[start] + horizon);
      const bool there = std::abs(times[row] - times[start] - horizon) <= 0.5 / recording.rate + kSameInstant;
      const bool comparable = there && row > start && recording.diabolo.valid[row] &&
                              gaps[static_cast<std::size_t>(row)] == gaps[static_cast<std::size_t>(start)];
      window.rows.push_back(comparable ? std::optional(row) : std::nullopt);
      if (comparable) window.last = std::max(window.last, row);
    }
    if (window.last > start) windows.push_back(std::move(window));
  }
  return windows;
}

}  // namespace diabolo
