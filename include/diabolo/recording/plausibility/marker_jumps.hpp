// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/recording/plausibility/swapped_bodies.hpp"
#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// Bounds of real motion, beyond those of any player: acceleration of a tip or a diabolo [m/s^2], change of
/// its velocity within a sample, as at a catch [m/s], and what noise may add [m]. A sample of which these do
/// not hold has a marker under another's name, or a reflection.
inline constexpr double kHardestAcceleration = 500.0, kMostKick = 15.0, kMostNoise = 0.03;

/// Longest time for which a body jumps away and back [s].
inline constexpr double kLongestJump = 0.05;

/// Marks the samples of a track that jump away from its motion and back within kLongestJump. Between samples
/// that are T apart no body leaves the chord by more than acceleration * T^2 / 8. Samples beside a dropout
/// are seen from one side only, and must leave the motion there by more than a kick explains. Linear in rows.
class JumpFinder {
 public:
  JumpFinder(const Track& track, const Recording& r) : track_(track), recording_(r), period_(1.0 / r.rate) {}

  /// True where a sample is not believed.
  Marks find() && {
    marks_ = Marks::Constant(track_.valid.size(), false);
    for (const bool backwards : {false, true}) {
      backwards_ = backwards;
      pass();
    }
    return std::move(marks_);
  }

 private:
  using Index = Eigen::Index;

  Index row(Index i) const { return backwards_ ? track_.valid.size() - 1 - i : i; }
  bool seen(Index i) const {
    return i >= 0 && i < track_.valid.size() && track_.valid[row(i)] && !marks_[row(i)];
  }
  /// Whether sample i + 1 is seen and follows sample i, which is seen.
  bool follows(Index i) const {
    return seen(i) && seen(i + 1) && recording_.steps_evenly(backwards_ ? row(i + 1) : row(i));
  }
  Eigen::Vector3d at(Index i) const { return track_.position.col(row(i)); }
  /// How far from its chord over that many periods a body may be [m].
  double sagitta(double periods) const {
    const double time = periods * period_;
    return kMostNoise + kHardestAcceleration * time * time / 8.0;
  }
  /// Whether sample i is where a body can be between the two others.
  bool keeps_on(Index before, Index i, Index after) const {
    const double periods = static_cast<double>(after - before);
    const double share = static_cast<double>(i - before) / periods;
    return (at(i) - at(before) - share * (at(after) - at(before))).norm() <= sagitta(periods);
  }

  void pass() {
    const Index size = track_.valid.size();
    for (Index i = 1; i + 1 < size; ++i) {
      if (!follows(i - 1) || !follows(i) || !keeps_on(i - 1, i, i + 1)) continue;
      for (Index before = i++; follows(i);) {  // the motion is known at both
        const Index next = keeps_on(before, i, i + 1) ? i + 1 : mark_jump(before, i);
        if (next == i) break;
        before = std::exchange(i, next);
      }
    }
  }

  /// Marks a jump right after sample i, into which the body came from the one before; returns the sample that
  /// is back on the motion, i for none.
  Index mark_jump(Index before, Index i) {
    const Index longest = std::clamp<Index>(std::lround(kLongestJump * recording_.rate), 1, 100);
    const Eigen::Vector3d step = (at(i) - at(before)) / static_cast<double>(i - before);
    for (Index k = 1; k <= longest; ++k) {
      if (!follows(i + k)) {
        mark_until_dropout(i, k, step);
        return i;
      }
      const Index back = i + k + 1;
      const double periods = static_cast<double>(k + 1);
      if ((at(back) - at(i) - periods * step).norm() > 4.0 * sagitta(periods)) continue;
      if (keeps_on(i, i + 1, back) || keeps_on(i, back - 1, back)) continue;
      for (Index j = i + 1; j < back; ++j)
        if (!keeps_on(i, j, back)) found_.push_back(row(j));
      return settle(), back;
    }
    return i;
  }

  /// The k samples after i, which a dropout follows: marked where all leave the motion.
  void mark_until_dropout(Index i, Index k, const Eigen::Vector3d& step) {
    for (Index j = 1; j <= k; ++j) {
      const double periods = static_cast<double>(j);
      if ((at(i + j) - at(i) - periods * step).norm() <=
          4.0 * sagitta(periods) + kMostKick * periods * period_)
        return found_.clear();
      found_.push_back(row(i + j));
    }
    settle();
  }

  void settle() {
    for (const Index j : found_) marks_[j] = true;
    found_.clear();
  }

  const Track& track_;
  const Recording& recording_;
  const double period_;
  Marks marks_;
  std::vector<Index> found_;
  bool backwards_ = false;
};

/// The samples in which each body jumps away and back (JumpFinder).
inline std::array<Marks, 3> find_jumps(Recording& r) {
  const std::array<Track*, 3> tracks = recording_plausibility_detail::tracks_of(r);
  return {JumpFinder(*tracks[0], r).find(), JumpFinder(*tracks[1], r).find(),
          JumpFinder(*tracks[2], r).find()};
}

/// Makes dropouts of samples in which a body jumps away and back, but for those that are no jumps once bodies
/// under each other's names have their own again (unswap). Returns how many; a note counts them by body.
inline Eigen::Index mask_jumps(Recording& r) {
  std::array<Marks, 3> jumps = find_jumps(r);
  if (!(jumps[0] || jumps[1] || jumps[2]).any()) return 0;
  Recording straight = r;
  if (const auto rows = unswap(straight).rows; !rows.empty()) {
    const auto [left, right, diabolo] = find_jumps(straight);
    for (const auto& [first, last] : rows)
      for (Marks& marks : jumps)
        marks.segment(first, last - first + 1) = marks.segment(first, last - first + 1) &&
                                                 (left || right || diabolo).segment(first, last - first + 1);
  }
  std::string counts;
  Eigen::Index total = 0;
  for (std::size_t b = 0; b < 3; ++b) {
    const Eigen::Index count = jumps[b].count();
    if (count == 0) continue;
    total += count;
    counts += (counts.empty() ? "" : ", ") + std::string(recording_plausibility_detail::kBodies[b]) + " " +
              std::to_string(count);
    recording_plausibility_detail::make_dropouts(r, b, jumps[b]);
  }
  if (total > 0)
    r.notes.push_back(
        "samples jump away and back faster than anything moves: they are left out as dropouts (" + counts +
        ")");
  return total;
}

}  // namespace diabolo
