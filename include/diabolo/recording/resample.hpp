// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "diabolo/recording/check.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/error.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Times closer than this [s] are the same instant: Motive writes them with six decimals, so that each is up
/// to half a microsecond off.
inline constexpr double kSameInstant = 2e-6;

/// The recording at other times [s], which must increase: linear between neighbouring samples for positions,
/// the short way round (slerp) for orientations; beyond half a turn per sample those alias, as spin does.
///
/// At a time within kSameInstant of a sample, that sample is copied bit for bit. Elsewhere a value is valid
/// only where both neighbours are, one sampling period apart: dropouts are never bridged, nothing is
/// extrapolated. The new rate is that of the median step, `frame` the nearest old frame. Throws
/// RecordingError where the times do not increase, or the recording is not what its type promises.
inline Recording resample(const Recording& recording, const Eigen::VectorXd& times) {
  check_recording(recording);
  const Eigen::Index size = times.size(), last = recording.size() - 1;
  const std::string where = "resampling of " + recording.title();
  if (last < 0) throw RecordingError(where + ": the recording has no samples");
  Recording result = recording;
  result.has_own_rows = true;
  result.time = times;
  if (size > 0) result.clock += times[0] - recording.time[0];
  result.frame.assign(static_cast<std::size_t>(size), 0);
  result.left = result.right = result.diabolo = Track::missing(size);
  const auto missing_like = [size](const OrientationTrack& track) {
    return track.empty() ? OrientationTrack{} : OrientationTrack::missing(size);
  };
  result.diabolo_orientation = missing_like(recording.diabolo_orientation);
  result.left_orientation = missing_like(recording.left_orientation);
  result.right_orientation = missing_like(recording.right_orientation);

  Eigen::Index i = 0;  // the last sample not after the time
  for (Eigen::Index k = 0; k < size; ++k) {
    const double time = times[k];
    if (!std::isfinite(time) || (k > 0 && !(time > times[k - 1])))
      throw RecordingError(where + ": time " + shown(time) + " s at index " + std::to_string(k) +
                           "; expected increasing times");
    while (i < last && recording.time[i + 1] <= time) ++i;
    const Eigen::Index nearest =
        i < last && recording.time[i + 1] - time < std::abs(time - recording.time[i]) ? i + 1 : i;
    const bool coincides = std::abs(recording.time[nearest] - time) <= kSameInstant;
    const bool between = time > recording.time[i] && recording.steps_evenly(i);
    const double u = between ? (time - recording.time[i]) / (recording.time[i + 1] - recording.time[i]) : 0.0;
    result.frame[static_cast<std::size_t>(k)] = recording.frame[static_cast<std::size_t>(nearest)];

    const auto position = [&](const Track& from, Track& to) {
      to.valid[k] = coincides ? from.valid[nearest] : between && from.valid[i] && from.valid[i + 1];
      if (!to.valid[k]) return;
      if (coincides)
        to.position.col(k) = from.position.col(nearest);
      else
        to.position.col(k) = (1.0 - u) * from.position.col(i) + u * from.position.col(i + 1);
    };
    position(recording.left, result.left);
    position(recording.right, result.right);
    position(recording.diabolo, result.diabolo);

    const auto orientation = [&](const OrientationTrack& from, OrientationTrack& to) {
      if (from.empty()) return;
      to.valid[k] = coincides ? from.valid[nearest] : between && from.valid[i] && from.valid[i + 1];
      if (!to.valid[k]) return;
      if (coincides) {
        to.quaternion.col(k) = from.quaternion.col(nearest);
      } else {
        const Eigen::Quaterniond a(Eigen::Vector4d(from.quaternion.col(i)));
        const Eigen::Quaterniond b(Eigen::Vector4d(from.quaternion.col(i + 1)));
        to.quaternion.col(k) = a.slerp(u, b).normalized().coeffs();
      }
    };
    orientation(recording.diabolo_orientation, result.diabolo_orientation);
    orientation(recording.left_orientation, result.left_orientation);
    orientation(recording.right_orientation, result.right_orientation);
  }
  if (size > 1) result.rate = 1.0 / median_step(times);
  return result;
}

/// The recording at another rate [Hz], from its first to its last sample; see above.
inline Recording resample(const Recording& recording, double rate) {
  check_rate(rate, {}, "resampling of " + recording.title());
  if (recording.size() == 0) return resample(recording, Eigen::VectorXd());
  const double start = recording.time[0], duration = recording.time[recording.size() - 1] - start;
  const double steps = std::floor((duration + kSameInstant) * rate);
  if (!(steps < 1e9)) throw RecordingError("resampling of " + recording.title() + ": more than 1e9 samples");
  Eigen::VectorXd times(static_cast<Eigen::Index>(steps) + 1);
  for (Eigen::Index k = 0; k < times.size(); ++k) times[k] = start + static_cast<double>(k) / rate;
  Recording result = resample(recording, times);
  result.rate = rate;
  return result;
}

}  // namespace diabolo
