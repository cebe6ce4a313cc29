// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// A rigid body that was tracked over N samples, in the frame of the motion capture.
struct TrackedBody {
  std::string name;
  Eigen::Matrix4Xd quaternion;  ///< x, y, z, w; 4 x N, body to capture frame, unit; NaN in a dropout; 4 x 0
                                ///< where only a point was tracked
  Eigen::Matrix3Xd position;    ///< of the body's origin [m], 3 x N; NaN in a dropout
  Marks valid;                  ///< N; false marks a dropout
};

/// A single marker over N samples, in the frame of the motion capture.
struct TrackedMarker {
  std::string name;
  bool measured;  ///< true: as the cameras saw it ("Marker"); false: as the solved body carries it
  Eigen::Matrix3Xd position;  ///< [m], 3 x N; NaN in a dropout
  Marks valid;                ///< N; false marks a dropout
};

/// A take of motion capture as a file has it, of whatever program, with nothing interpreted.
struct TrackedTake {
  std::string file_name;
  double rate = 0.0;        ///< nominal sampling rate [Hz]
  std::vector<long> frame;  ///< strictly increasing, from any number
  Eigen::VectorXd time;     ///< [s], strictly increasing
  std::vector<TrackedBody> bodies;
  std::vector<TrackedMarker> markers;
  std::vector<std::string> notes;  ///< what its reader changed or took for granted, a clause each
};

}  // namespace diabolo
