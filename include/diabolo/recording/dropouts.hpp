// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// The track with each dropout filled by the last valid position before it, as the published evaluation
/// treats a missing tip. Dropouts before the first valid sample stay.
inline Track hold_last_valid(Track track) {
  for (Eigen::Index i = 1; i < track.valid.size(); ++i) {
    if (track.valid[i] || !track.valid[i - 1]) continue;
    track.position.col(i) = track.position.col(i - 1);
    track.valid[i] = true;
  }
  return track;
}

/// Marks with every dropout widened by `samples` on both sides.
inline Marks widen_dropouts(const Marks& valid, Eigen::Index samples) {
  Marks result = valid;
  for (Eigen::Index i = 0; i < valid.size(); ++i) {
    if (valid[i]) continue;
    const Eigen::Index last = std::min(valid.size() - 1, i + samples);
    for (Eigen::Index k = std::max<Eigen::Index>(0, i - samples); k <= last; ++k) result[k] = false;
  }
  return result;
}

/// The recording with the diabolo's dropouts widened by `samples` on both sides, in position and orientation:
/// beside a dropout Motive solves the body from too few markers, and in the published takes the pose there is
/// off by several millimetres and half a frame's turn.
inline Recording without_dropout_edges(Recording recording, Eigen::Index samples = 1) {
  recording.diabolo.valid = widen_dropouts(recording.diabolo.valid, samples);
  recording.diabolo_orientation.valid = widen_dropouts(recording.diabolo_orientation.valid, samples);
  for (Eigen::Index i = 0; i < recording.diabolo.valid.size(); ++i)
    if (!recording.diabolo.valid[i]) recording.diabolo.position.col(i).setConstant(kNaN);
  for (Eigen::Index i = 0; i < recording.diabolo_orientation.valid.size(); ++i)
    if (!recording.diabolo_orientation.valid[i])
      recording.diabolo_orientation.quaternion.col(i).setConstant(kNaN);
  return recording;
}

}  // namespace diabolo
