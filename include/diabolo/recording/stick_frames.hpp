// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// Stick frames in each row, held over dropouts; the world's where none were recorded.
inline std::vector<Eigen::Matrix3d> stick_frames(const OrientationTrack& track, Eigen::Index size) {
  std::vector<Eigen::Matrix3d> frames(static_cast<std::size_t>(size), Eigen::Matrix3d::Identity());
  if (track.empty()) return frames;
  Eigen::Index seen = -1;
  for (Eigen::Index i = 0; i < size; ++i) {
    if (track.valid[i]) {
      const Eigen::Matrix3d frame =
          Eigen::Quaterniond(Eigen::Vector4d(track.quaternion.col(i))).toRotationMatrix();
      if (seen < 0) std::fill_n(frames.begin(), i, frame);
      frames[static_cast<std::size_t>(i)] = frame;
      seen = i;
    } else if (seen >= 0) {
      frames[static_cast<std::size_t>(i)] = frames[static_cast<std::size_t>(seen)];
    }
  }
  return frames;
}

}  // namespace diabolo
