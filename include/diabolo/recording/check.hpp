// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/parameters.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/recording/usual_step.hpp"
#include "diabolo/text/error.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Largest departure of a quaternion's norm from 1 that is taken for rounding and normalised away.
inline constexpr double kQuaternionTolerance = 1e-3;

/// Largest coordinate [m] that is believed; beyond it a file is taken to be in other units, or broken.
inline constexpr double kLargestCoordinate = 100.0;

/// Largest time [s] that is believed.
inline constexpr double kLargestTime = 1e9;

/// Longest gap between two rows [s]; predictions may run through it, so that it must not be without end.
inline constexpr double kLongestGap = 3600.0;

/// Longest recording [s]: a day; predictions run through all of it.
inline constexpr double kLongestRecording = 86400.0;

/// Cups of a diabolo that are believed [m].
inline constexpr double kSmallestCup = 0.01, kLargestCup = 1.0;

/// Normalises a quaternion whose norm is within kQuaternionTolerance of 1; false, and no change, beyond it.
/// One that is unit to rounding stays as it is, bit for bit, so that files round-trip.
inline bool normalize_quaternion(Eigen::Ref<Eigen::Vector4d> quaternion) {
  const double norm = quaternion.norm();
  if (!(std::abs(norm - 1.0) <= kQuaternionTolerance)) return false;
  if (std::abs(norm - 1.0) > 1e-15) quaternion /= norm;
  return true;
}

/// Largest departure of the rate of the times from the one that is stated, as a share of it.
inline constexpr double kRateTolerance = 0.05;

/// Whether times, in a unit [s], step at that rate [Hz]: within kRateTolerance in the median, or in the step
/// that leaves no row out.
inline bool steps_at(double rate, const Eigen::VectorXd& time, double unit = 1.0) {
  const auto fits = [&](double step) { return std::abs(step * unit * rate - 1.0) <= kRateTolerance; };
  return fits(median_step(time)) || fits(usual_step(time));
}

namespace recording_detail {

/// The step [s] that four of five are no longer than. There must be two times at least.
inline double long_step(const Eigen::VectorXd& time) {
  Eigen::VectorXd step = time.tail(time.size() - 1) - time.head(time.size() - 1);
  double* const longer = step.data() + 4 * step.size() / 5;
  std::nth_element(step.data(), longer, step.data() + step.size());
  return *longer;
}

inline constexpr Eigen::Index kFewestTimes = 20;  ///< of fewer the longer steps may be gaps

}  // namespace recording_detail

/// Throws RecordingError where many rows come at once with the one before, such as two rows for each instant:
/// a quarter of the steps are shorter than a hundredth of the longer ones.
inline void check_instants(const Eigen::VectorXd& time, const std::string& where) {
  if (time.size() < recording_detail::kFewestTimes) return;
  const double at_once = 0.01 * recording_detail::long_step(time);
  const Eigen::Index steps = time.size() - 1,
                     count = ((time.tail(steps) - time.head(steps)).array() < at_once).count();
  if (4 * count < steps) return;
  throw RecordingError(where + ": " + std::to_string(count) + " of " + std::to_string(time.size()) +
                       " rows come within " + shown_rounded(1e3 * at_once) +
                       " ms of the row before, as if an instant had several; expected one row an instant");
}

/// Throws RecordingError where one row comes so soon behind another that no motion is known between them: by
/// less than a thousandth of the longer steps.
inline void check_rows_apart(const Eigen::VectorXd& time, const std::string& where) {
  if (time.size() < recording_detail::kFewestTimes) return;
  const double least = 1e-3 * recording_detail::long_step(time);
  for (Eigen::Index i = 1; i < time.size(); ++i)
    if (time[i] - time[i - 1] < least)
      throw RecordingError(where + ": the row at " + shown_rounded(time[i]) + " s comes " +
                           shown_rounded(1e6 * (time[i] - time[i - 1])) +
                           " us after the one before; expected one row an instant");
}

/// Throws RecordingError unless the sampling rate [Hz] is believable and fits the times, see steps_at(); says
/// so where they would in a smaller unit.
inline void check_rate(double rate, const Eigen::VectorXd& time, const std::string& where) {
  if (!(rate > 0.0 && rate <= 1e6))
    throw RecordingError(where + ": rate " + shown(rate) + " Hz; expected more than 0, at most 1e6");
  if (time.size() < 2) return;
  check_instants(time, where);
  if (steps_at(rate, time)) return;
  std::string unit;
  for (const auto& [name, seconds] : {std::pair{"ns", 1e-9}, std::pair{"us", 1e-6}, std::pair{"ms", 1e-3}})
    if (steps_at(rate, time, seconds)) unit = name;
  throw RecordingError(
      where + ": rate " + shown_rounded(rate) + " Hz, but the times step by " +
      shown(std::round(1e6 * usual_step(time)) / 1e6) + " s (" + shown_rounded(1.0 / usual_step(time)) +
      " Hz)" + (unit.empty() ? "" : ", as if they were in " + unit + ": --columns time=NAME[" + unit + "]"));
}

/// Throws RecordingError unless the sizes of the cups are believable, and mass, axle and string length such
/// as Parameters allow.
inline void check_properties(const DiaboloProperties& properties, double string_length,
                             const std::string& where) {
  const auto check = [&where](const std::string& field, double value, double minimum, double maximum) {
    if (!(value >= minimum && value <= maximum))
      throw RecordingError(where + ": " + field + " " + shown(value) + "; expected " + shown(minimum) +
                           " to " + shown(maximum));
  };
  check("diabolo.diameter [m]", properties.diameter, kSmallestCup, kLargestCup);
  check("diabolo.length [m]", properties.length, kSmallestCup, kLargestCup);
  Parameters<double> parameters;
  parameters.mass = properties.mass;
  parameters.axle_radius = properties.axle_radius;
  parameters.string_length = string_length;
  Parameters<double>::for_each(parameters, [&](const ParameterInfo& info, double value) {
    const std::string owner = info.name == "string_length" ? "" : "diabolo.";
    check(owner + std::string(info.name) + " [" + std::string(info.unit) + "]", value, info.minimum,
          info.maximum);
  });
  if (2.0 * properties.axle_radius >= properties.diameter)
    throw RecordingError(where + ": diabolo.axle_radius [m] " + shown(properties.axle_radius) +
                         ": an axle as thick as the cups; expected less than half of diabolo.diameter [m], " +
                         shown(0.5 * properties.diameter));
}

/// Throws RecordingError unless each of these names is one of kAssumable, and there once.
inline void check_assumed(const std::vector<std::string>& names, const std::string& where) {
  const auto fail = [&where](const std::string& what) {
    std::string expected;
    for (const char* const name : kAssumable) expected += (expected.empty() ? "" : " or ") + shown(name);
    throw RecordingError(where + ": assumed: " + what + "; expected " + expected + ", each once");
  };
  for (const std::string& name : names) {
    if (std::ranges::count(kAssumable, name) == 0) fail(shown(name));
    if (std::ranges::count(names, name) > 1) fail(shown(name) + " is there twice");
  }
}

/// Throws RecordingError unless the track has `size` samples: believable where valid, NaN in dropouts.
inline void check_track(const Track& track, Eigen::Index size, const std::string& where) {
  if (track.position.cols() != size || track.valid.size() != size)
    throw RecordingError(where + ": " + std::to_string(track.position.cols()) + " positions and " +
                         std::to_string(track.valid.size()) + " marks; expected " + std::to_string(size));
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto position = track.position.col(i);
    if (track.valid[i] ? !(position.cwiseAbs().array() <= kLargestCoordinate).all()
                       : !position.array().isNaN().all())
      throw RecordingError(where + ", sample " + std::to_string(i) + ": position (" + shown(position.x()) +
                           ", " + shown(position.y()) + ", " + shown(position.z()) + ") m; expected " +
                           (track.valid[i] ? "numbers within 100 m" : "NaN in a dropout"));
  }
}

/// Throws RecordingError unless the track is empty or has `size` samples: unit where valid, NaN in dropouts.
inline void check_track(const OrientationTrack& track, Eigen::Index size, const std::string& where) {
  if (track.empty() && track.valid.size() == 0) return;
  if (track.quaternion.cols() != size || track.valid.size() != size)
    throw RecordingError(where + ": " + std::to_string(track.quaternion.cols()) + " orientations and " +
                         std::to_string(track.valid.size()) + " marks; expected " + std::to_string(size));
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto quaternion = track.quaternion.col(i);
    if (track.valid[i] ? !(std::abs(quaternion.norm() - 1.0) < 1e-9) : !quaternion.array().isNaN().all())
      throw RecordingError(where + ", sample " + std::to_string(i) + ": quaternion of norm " +
                           shown(quaternion.norm()) + "; expected " +
                           (track.valid[i] ? "1" : "NaN in a dropout"));
  }
}

/// Throws RecordingError unless `recording` is what its type promises. Readers only return such recordings;
/// writers and filters check those made by hand.
inline void check_recording(const Recording& recording) {
  const std::string where = recording.title();
  const Eigen::Index size = recording.size();
  if (static_cast<Eigen::Index>(recording.frame.size()) != size)
    throw RecordingError(where + ": " + std::to_string(recording.frame.size()) + " frame numbers and " +
                         std::to_string(size) + " times; expected as many");
  for (Eigen::Index i = 0; i < size; ++i)
    if (!(std::abs(recording.time[i]) <= kLargestTime) ||
        (i > 0 && !(recording.time[i] > recording.time[i - 1])))
      throw RecordingError(where + ", sample " + std::to_string(i) + ": time " + shown(recording.time[i]) +
                           " s; expected increasing times within 1e9 s");
  for (Eigen::Index i = 1; i < size; ++i)
    if (recording.time[i] - recording.time[i - 1] > kLongestGap)
      throw RecordingError(where + ", sample " + std::to_string(i) + ": time " + shown(recording.time[i]) +
                           " s comes " + shown(recording.time[i] - recording.time[i - 1]) +
                           " s after the one before; expected a gap of an hour at most");
  if (size > 0 && recording.time[size - 1] - recording.time[0] > kLongestRecording)
    throw RecordingError(where + ": " + shown(recording.time[size - 1] - recording.time[0]) +
                         " s from the first sample to the last; expected a day at most");
  check_rate(recording.rate, recording.time, where);
  check_properties(recording.properties, recording.string_length, where);
  check_assumed(recording.assumed, where);
  check_track(recording.left, size, where + ", left tip");
  check_track(recording.right, size, where + ", right tip");
  check_track(recording.diabolo, size, where + ", diabolo");
  check_track(recording.diabolo_orientation, size, where + ", diabolo orientation");
  check_track(recording.left_orientation, size, where + ", left orientation");
  check_track(recording.right_orientation, size, where + ", right orientation");
}

}  // namespace diabolo
