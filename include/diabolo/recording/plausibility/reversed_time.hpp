// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// The rows of a recording from its last to its first, at times that increase again.
inline Recording with_time_reversed(Recording r) {
  const auto turn = [](auto& columns) { columns = columns.rowwise().reverse().eval(); };
  for (Track* track : {&r.left, &r.right, &r.diabolo}) {
    turn(track->position);
    track->valid.reverseInPlace();
  }
  for (OrientationTrack* track : {&r.diabolo_orientation, &r.left_orientation, &r.right_orientation}) {
    turn(track->quaternion);
    track->valid.reverseInPlace();
  }
  if (r.size() > 0) r.time = (r.time[0] + r.time[r.size() - 1] - r.time.array()).reverse().eval();
  return r;
}

}  // namespace diabolo
