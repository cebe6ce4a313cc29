// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

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

/// Motion of the stick tips over a recording, time zero at its row 0. Held: a missing tip stays where it was
/// seen last (see kHeldDelay). Linear and spline: each tip runs through its own valid samples. Rows before
/// both tips have been seen are left out; the tips rest there at their first poses. Throws RecordingError
/// where the tips are never seen together.
TipMotion<double> tip_motion(const Recording& recording, Interpolation interpolation);

}  // namespace diabolo
