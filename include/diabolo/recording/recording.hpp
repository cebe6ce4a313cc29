// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "diabolo/text/error.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// One mark per sample.
using Marks = Eigen::Array<bool, Eigen::Dynamic, 1>;

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Positions over N samples, world frame (x forward, y left, z up).
struct Track {
  Eigen::Matrix3Xd position;  ///< [m], 3 x N; NaN in a dropout, so that using one is loud
  Marks valid;                ///< N; false marks a dropout

  /// A track of dropouts.
  static Track missing(Eigen::Index size) {
    return {Eigen::Matrix3Xd::Constant(3, size, kNaN), Marks::Constant(size, false)};
  }
};

/// Orientations, body to world, over N samples; no columns where none were recorded.
struct OrientationTrack {
  Eigen::Matrix4Xd quaternion;  ///< x, y, z, w; 4 x N, unit; NaN in a dropout
  Marks valid;                  ///< N; false marks a dropout

  /// A track of dropouts.
  static OrientationTrack missing(Eigen::Index size) {
    return {Eigen::Matrix4Xd::Constant(4, size, kNaN), Marks::Constant(size, false)};
  }
  bool empty() const { return quaternion.cols() == 0; }
};

/// What a diabolo is like. The presets are the paper's four, bare: its eight markers of about 0.6 g are not
/// included.
struct DiaboloProperties {
  double mass;         ///< [kg]
  double diameter;     ///< of the cups [m]
  double length;       ///< along the axle [m]
  double axle_radius;  ///< where the string runs [m]
};
inline constexpr DiaboloProperties kRedDiabolo{0.2845, 0.127, 0.143, 0.0065};
inline constexpr DiaboloProperties kBlueDiabolo{0.2895, 0.127, 0.143, 0.0065};  ///< runs on a bearing
inline constexpr DiaboloProperties kPatternedDiabolo{0.2180, 0.097, 0.114, 0.0065};
inline constexpr DiaboloProperties kGreenDiabolo{0.1415, 0.082, 0.093, 0.0065};

/// String length of the published evaluation [m].
inline constexpr double kPublishedStringLength = 1.46;

/// What of a set-up may be assumed, as fields of a recording's JSON file name it.
inline constexpr std::array kAssumable{"string_length", "diabolo"};

/// A recorded play: stick tips and diabolo over N samples in the world frame.
struct Recording {
  std::string name;
  double rate = 0.0;                                     ///< nominal sampling rate [Hz]
  std::vector<long> frame;                               ///< number of each sample in its take
  Eigen::VectorXd time;                                  ///< [s], strictly increasing; from any origin
  Track left, right;                                     ///< the stick tips
  Track diabolo;                                         ///< the centre of the axle
  OrientationTrack diabolo_orientation;                  ///< body x is the spin axis
  OrientationTrack left_orientation, right_orientation;  ///< body x runs along the stick, outwards
  DiaboloProperties properties = kRedDiabolo;
  double string_length = kPublishedStringLength;  ///< [m]
  std::vector<std::string> assumed;               ///< those of kAssumable that no file told
  double clock = 0.0;              ///< of laws in time, at sample 0 [s]: a part keeps that of the whole
  std::vector<std::string> notes;  ///< what its reader changed or took for granted, a clause each
  std::string file;                ///< that it was read from; empty where it is of none
  bool has_own_rows = false;       ///< its samples are others than the file's rows: a part, or resampled

  /// What messages call it. Those about a part, or a resampled one, name no rows of the file.
  std::string title() const {
    if (file.empty()) return "recording " + shown(name);
    return has_own_rows ? "recording " + shown(name) + " (from " + file + ")" : file;
  }

  Eigen::Index size() const { return time.size(); }

  /// Whether sample i + 1 exists and follows sample i by one period, give or take a tenth. Whatever is
  /// computed from neighbours (spin, velocity, resampling) treats a wider or narrower step like a dropout.
  bool steps_evenly(Eigen::Index i) const {
    return i + 1 < size() && std::abs((time[i + 1] - time[i]) * rate - 1.0) <= 0.1;
  }
};

/// Rows first to last, both included. Throws RecordingError where the recording lacks them.
inline Recording cut(const Recording& recording, Eigen::Index first, Eigen::Index last) {
  if (first < 0 || last < first || last >= recording.size())
    throw RecordingError("cut of " + recording.title() + ": rows " + std::to_string(first) + " to " +
                         std::to_string(last) + "; expected 0 <= first <= last < " +
                         std::to_string(recording.size()));
  const Eigen::Index n = last - first + 1;
  const auto cut_track = [&](const Track& track) {
    return Track{track.position.middleCols(first, n), track.valid.segment(first, n)};
  };
  const auto cut_orientation = [&](const OrientationTrack& track) {
    if (track.empty()) return track;
    return OrientationTrack{track.quaternion.middleCols(first, n), track.valid.segment(first, n)};
  };
  Recording result = recording;
  result.has_own_rows = result.has_own_rows || n < recording.size();
  result.frame.assign(recording.frame.begin() + first, recording.frame.begin() + last + 1);
  result.time = recording.time.segment(first, n);
  result.clock += recording.time[first] - recording.time[0];
  result.left = cut_track(recording.left);
  result.right = cut_track(recording.right);
  result.diabolo = cut_track(recording.diabolo);
  result.diabolo_orientation = cut_orientation(recording.diabolo_orientation);
  result.left_orientation = cut_orientation(recording.left_orientation);
  result.right_orientation = cut_orientation(recording.right_orientation);
  return result;
}

}  // namespace diabolo
