// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "diabolo/recording/dropouts.hpp"
#include "diabolo/recording/error.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/recording/resample.hpp"
#include "diabolo/recording/text.hpp"
#include "diabolo/sticks.hpp"

namespace diabolo {

/// How much later than its instant a held pose sets in [s]. In the published evaluation a pose counts from
/// the first step strictly after its instant, while TipMotion gives it at the instant itself; a delay below
/// any step and above the rounding of the times is the difference.
inline constexpr double kHeldDelay = 1e-9;

/// Time of each row since row 0 [s]: from the frame numbers, which are exact, where the written times agree
/// with them to their last digit (kSameInstant); else from the written times.
inline Eigen::VectorXd row_times(const Recording& recording) {
  const Eigen::Index size = recording.size();
  Eigen::VectorXd times(size);
  bool exact = recording.frame.size() == static_cast<std::size_t>(size);
  for (Eigen::Index i = 0; i < size && exact; ++i) {
    times[i] = static_cast<double>(recording.frame[static_cast<std::size_t>(i)] - recording.frame.front()) /
               recording.rate;
    exact = std::abs(recording.time[i] - recording.time[0] - times[i]) <= kSameInstant;
  }
  if (!exact) times = recording.time.array() - recording.time[0];
  return times;
}

/// The rows in which a stick tip may take part in a motion: from its first valid row to its last one.
struct TipSpan {
  Eigen::Index first, last;
};

/// Throws RecordingError where the tip is never seen.
inline TipSpan tip_span(const Track& tip, const Recording& recording, const char* side) {
  TipSpan span{0, tip.valid.size() - 1};
  while (span.first <= span.last && !tip.valid[span.first]) ++span.first;
  while (span.first <= span.last && !tip.valid[span.last]) --span.last;
  if (span.first > span.last)
    throw RecordingError("recording " + shown(recording.name) + ": the " + side + " tip is never seen");
  return span;
}

/// The tip with each gap filled from the curve through its own valid samples. A natural spline through points
/// of a natural spline is that spline, so that filled points leave the curve as it is.
inline Track fill_gaps(Track tip, const TipSpan& span, const Eigen::VectorXd& times,
                       Interpolation interpolation) {
  if (interpolation == Interpolation::kHeld) return hold_last_valid(std::move(tip));
  std::vector<double> instants;
  std::vector<Vector3<double>> points;
  for (Eigen::Index i = span.first; i <= span.last; ++i) {
    if (!tip.valid[i]) continue;
    instants.push_back(times[i]);
    points.emplace_back(tip.position.col(i));
  }
  if (static_cast<Eigen::Index>(points.size()) == span.last - span.first + 1) return tip;
  const TipMotion<double> curve(std::move(instants), points, points, interpolation);
  std::size_t hint = 0;
  for (Eigen::Index i = span.first; i <= span.last; ++i) {
    if (tip.valid[i]) continue;
    tip.position.col(i) = curve.at(times[i], hint).left;
    tip.valid[i] = true;
  }
  return tip;
}

/// Motion of the stick tips over a recording, time zero at its row 0. Held: a missing tip stays where it was
/// seen last (see kHeldDelay). Linear and spline: each tip runs through its own valid samples. Rows that one
/// of the tips does not reach are left out; both tips rest there. Throws RecordingError where the tips are
/// never seen at the same time.
inline TipMotion<double> tip_motion(const Recording& recording, Interpolation interpolation) {
  const Eigen::VectorXd times = row_times(recording);
  const TipSpan left_span = tip_span(recording.left, recording, "left");
  const TipSpan right_span = tip_span(recording.right, recording, "right");
  const Track left = fill_gaps(recording.left, left_span, times, interpolation);
  const Track right = fill_gaps(recording.right, right_span, times, interpolation);
  std::vector<double> instants;
  std::vector<Vector3<double>> left_points, right_points;
  for (Eigen::Index i = 0; i < recording.size(); ++i) {
    if (!left.valid[i] || !right.valid[i]) continue;
    instants.push_back(times[i] + (interpolation == Interpolation::kHeld ? kHeldDelay : 0.0));
    left_points.emplace_back(left.position.col(i));
    right_points.emplace_back(right.position.col(i));
  }
  if (instants.empty())
    throw RecordingError("recording " + shown(recording.name) + ": the tips are never seen at the same time");
  return TipMotion<double>(std::move(instants), left_points, right_points, interpolation);
}

}  // namespace diabolo
