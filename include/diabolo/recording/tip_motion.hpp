// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "diabolo/recording/dropouts.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/recording/resample.hpp"
#include "diabolo/recording/stick_frames.hpp"
#include "diabolo/sticks.hpp"
#include "diabolo/text/error.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Step of the published evaluation [s]; the per-step factors of the published rules belong to it.
inline constexpr double kEvaluationStep = 1e-3;

/// How much later than its instant a held pose sets in [s]. In the published evaluation a pose counts in the
/// first step that begins strictly after its instant, while the predictor asks for the tips at the end of a
/// step, and TipMotion gives a pose at its instant itself: one step, and a bit above the rounding of times.
inline constexpr double kHeldDelay = kEvaluationStep + 1e-9;

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
    throw RecordingError(recording.title() + ": the " + side + " tip is never seen");
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

/// The stick tips of a recording, ready to be followed; time zero at its row 0, Tips::time by its clock.
/// Held: a missing tip stays where it was seen last (see kHeldDelay). Linear and spline: each tip runs
/// through its own valid samples. Rows that one of the tips does not reach are left out; both tips rest
/// there.
class RecordedTips {
 public:
  /// Throws RecordingError where the tips are never seen at the same time.
  RecordedTips(const Recording& recording, Interpolation interpolation)
      : interpolation_(interpolation), clock_(recording.clock), times_(row_times(recording)) {
    for (const auto& [track, sticks] : {std::pair{&recording.left_orientation, &left_sticks_},
                                        std::pair{&recording.right_orientation, &right_sticks_}})
      for (const Eigen::Matrix3d& frame : stick_frames(*track, recording.size()))
        sticks->emplace_back(track->empty() ? Vector3<double>::Zero() : Vector3<double>(frame.col(0)));
    left_ = fill_gaps(recording.left, tip_span(recording.left, recording, "left"), times_, interpolation);
    right_ = fill_gaps(recording.right, tip_span(recording.right, recording, "right"), times_, interpolation);
    if (!(left_.valid && right_.valid).any())
      throw RecordingError(recording.title() + ": the tips are never seen at the same time");
    if (interpolation != Interpolation::kHeld)
      whole_ = std::make_shared<TipMotion<double>>(through(0, recording.size() - 1));
  }

  /// Time of each row [s].
  const Eigen::VectorXd& times() const { return times_; }

  /// The motion for a prediction from row `first` to row `last`. Held, it begins with the pose of the first
  /// row, which so counts from the start on; else it is that of the whole recording. Between the rows both
  /// tips must be seen in one row at least.
  std::shared_ptr<const TipMotion<double>> motion(Eigen::Index first, Eigen::Index last) const {
    return whole_ ? whole_ : std::make_shared<TipMotion<double>>(through(first, last));
  }

 private:
  TipMotion<double> through(Eigen::Index first, Eigen::Index last) const {
    const double delay = interpolation_ == Interpolation::kHeld ? kHeldDelay : 0.0;
    std::vector<double> instants;
    std::vector<Vector3<double>> left, right, left_sticks, right_sticks;
    for (Eigen::Index i = first; i <= last; ++i) {
      if (!left_.valid[i] || !right_.valid[i]) continue;
      left_sticks.push_back(left_sticks_[static_cast<std::size_t>(i)]);
      right_sticks.push_back(right_sticks_[static_cast<std::size_t>(i)]);
      instants.push_back(times_[i] + delay);
      left.emplace_back(left_.position.col(i));
      right.emplace_back(right_.position.col(i));
    }
    TipMotion<double> motion(std::move(instants), left, right, interpolation_);
    motion.point_along(left_sticks, right_sticks);
    motion.start_clock(clock_);
    return motion;
  }

  Interpolation interpolation_;
  double clock_;
  Eigen::VectorXd times_;
  Track left_, right_;                                       ///< gaps filled
  std::vector<Vector3<double>> left_sticks_, right_sticks_;  ///< directions; zero where not recorded
  std::shared_ptr<const TipMotion<double>> whole_;
};

/// Motion of the stick tips over a whole recording; see RecordedTips.
inline TipMotion<double> tip_motion(const Recording& recording, Interpolation interpolation) {
  return *RecordedTips(recording, interpolation).motion(0, recording.size() - 1);
}

}  // namespace diabolo
