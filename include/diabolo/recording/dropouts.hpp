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
inline Mask widen_dropouts(const Mask& valid, Eigen::Index samples) {
  Mask result = valid;
  for (Eigen::Index i = 0; i < valid.size(); ++i) {
    if (valid[i]) continue;
    const Eigen::Index first = std::max<Eigen::Index>(0, i - samples);
    result.segment(first, std::min(valid.size(), i + samples + 1) - first).setConstant(false);
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
