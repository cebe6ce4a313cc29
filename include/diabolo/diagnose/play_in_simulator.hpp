// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/corrected.hpp"
#include "diabolo/diagnose/final_fit.hpp"
#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/math/shortest_turn.hpp"
#include "diabolo/recording/played_recording.hpp"

// Somebody's simulator is asked to play what was recorded: stretch by stretch from recorded starts, so that
// it never is far from reality.
namespace diabolo {

/// What a simulator gives: the states at some times [s] of a motion of the tips, from a start at time zero. A
/// spin of NaN is not known, nor is such an axis.
using Simulate = std::function<std::vector<State<double>>(
    const State<double>& start, const TipMotion<double>& tips, const Eigen::VectorXd& times)>;

/// Length of a stretch [s], and what is left out between two.
inline constexpr double kStretchTime = 1.5, kStretchGap = 0.15;

/// Rows of a take that are played from a start of their own.
struct Stretch {
  Eigen::Index first, last;  ///< both included
  State<double> start;
};

/// A take without the faults that were found, the model that the other takes, or parts, say it has, and what
/// a simulator is to play of it.
struct TakeToPlay {
  Recording recording;
  Model model;
  std::vector<Stretch> stretches;
};

/// The same seen in a frame in which gravity points along -z; it points along (x, y, -sqrt(1 - x^2 - y^2)).
inline Recording levelled(Recording recording, double x, double y) {
  const Eigen::Vector3d down(x, y, -std::sqrt(1.0 - x * x - y * y));
  const Eigen::Quaterniond turn = shortest_turn(down, -Eigen::Vector3d::UnitZ());
  for (Track* track : {&recording.left, &recording.right, &recording.diabolo})
    track->position = turn.toRotationMatrix() * track->position;
  for (OrientationTrack* track :
       {&recording.left_orientation, &recording.right_orientation, &recording.diabolo_orientation})
    for (Eigen::Index i = 0; i < track->quaternion.cols(); ++i)
      track->quaternion.col(i) =
          (turn * Eigen::Quaterniond(Eigen::Vector4d(track->quaternion.col(i)))).coeffs();
  return recording;
}

/// Stretches of a recording, one after the other, that begin where the diabolo's state is known.
inline std::vector<Stretch> stretches_of(const Recording& recording) {
  const StartStates starts(recording, true);
  const Eigen::VectorXd times = row_times(recording);
  const std::vector<bool> left = in_long_gap(recording.left, times),
                          right = in_long_gap(recording.right, times);
  const auto goes_on = [&](Eigen::Index row) {
    const std::size_t i = static_cast<std::size_t>(row);
    return row + 1 < recording.size() && recording.steps_evenly(row) && !left[i] && !right[i];
  };
  std::vector<Stretch> stretches;
  for (Eigen::Index row = 0; row < recording.size();) {
    if (!starts.known(Start::kFair, row)) {
      ++row;
      continue;
    }
    Eigen::Index last = row;
    while (goes_on(last) && times[last] - times[row] < kStretchTime) ++last;
    if (times[last] - times[row] > 0.5 * kStretchTime)
      stretches.push_back({row, last, starts.at(Start::kFair, row)});
    while (++row < recording.size() && times[row] < times[last] + kStretchGap) {
    }
  }
  return stretches;
}

/// What a simulator is to play of the recordings, or of those that were held out. The axle is as recorded,
/// lengths and tips as they were found to be by all recordings, so that all stretches are of one set-up, and
/// the frame is level. The models' physics is that of the other takes, or parts.
inline std::vector<TakeToPlay> takes_to_play(const Diagnosis& real, const std::vector<Recording>& holdout) {
  std::vector<TakeToPlay> takes;
  if (!real.final_fit) return takes;
  const Fit& fit = real.final_fit->fit;
  for (const HeldOutRecording& held : leave_out(fit, Evidence(fit), real.final_fit->free, {}, holdout)) {
    Recording level = levelled(corrected(held.recording, fit.at), fit.at[index_of(Unknown::kTiltX)],
                               fit.at[index_of(Unknown::kTiltY)]);
    UnknownVector at = held.at;
    at[index_of(Unknown::kTiltX)] = at[index_of(Unknown::kTiltY)] = 0.0;
    std::vector<Stretch> stretches = stretches_of(level);
    takes.push_back(
        {std::move(level), augmented_model(real.final_fit->physics, at, "real"), std::move(stretches)});
  }
  return takes;
}

/// The tips of a stretch, from time zero on.
inline TipMotion<double> tips_of(const TakeToPlay& take, const Stretch& stretch) {
  return tip_motion(cut(take.recording, stretch.first, stretch.last), Interpolation::kSpline);
}

/// The times of its rows, from zero on.
inline Eigen::VectorXd row_times(const TakeToPlay& take, const Stretch& stretch) {
  return diabolo::row_times(cut(take.recording, stretch.first, stretch.last));
}

/// Throws std::invalid_argument where a simulator gave something else than a state for each row.
inline void check_played(const std::vector<State<double>>& states, const TakeToPlay& take,
                         const Stretch& stretch) {
  const std::size_t expected = static_cast<std::size_t>(stretch.last - stretch.first + 1);
  const std::string where = "simulate: from " + shown(take.recording.time[stretch.first]) + " s of " +
                            shown(take.recording.name) + " on, ";
  if (states.size() != expected)
    throw std::invalid_argument(where + std::to_string(states.size()) + " states; expected " +
                                std::to_string(expected) + ", one for each time");
  for (std::size_t i = 0; i < states.size(); ++i)
    if (!states[i].position.allFinite() || std::isinf(states[i].spin))
      throw std::invalid_argument(where + "state " + std::to_string(i) + " is not finite; expected it to be");
}

/// A take as a simulator played it: the tips that it was given, and the diabolo where it put that, which
/// turns where all spins are known.
inline Recording with_diabolo(const TakeToPlay& take, const std::vector<std::vector<State<double>>>& played) {
  std::vector<State<double>> states;
  std::vector<double> times;
  std::vector<Vector3<double>> left, right;
  for (std::size_t s = 0; s < take.stretches.size(); ++s) {
    const TipMotion<double> tips = tips_of(take, take.stretches[s]);
    const Eigen::VectorXd since = row_times(take, take.stretches[s]);
    std::size_t hint = 0;
    for (std::size_t i = 0; i < played[s].size(); ++i) {
      const Eigen::Index row = static_cast<Eigen::Index>(i);
      const Tips<double> now = tips.at(since[row], hint);
      times.push_back(take.recording.time[take.stretches[s].first + row]);
      left.push_back(now.left);
      right.push_back(now.right);
      states.push_back(played[s][i]);
    }
  }
  const bool turns = std::ranges::none_of(states, [](const auto& state) { return std::isnan(state.spin); });
  if (!turns)
    for (State<double>& state : states) state.spin = 0.0;
  for (State<double>& state : states)
    if (!state.axis.allFinite()) state.axis = State<double>().axis;
  const auto columns = [](const std::vector<Vector3<double>>& points) {
    Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = points[i];
    return result;
  };
  const Eigen::Map<const Eigen::VectorXd> time(times.data(), static_cast<Eigen::Index>(times.size()));
  Recording result =
      played_recording(take.recording.name, time, columns(left), columns(right), states, take.recording.rate,
                       take.recording.properties, take.recording.string_length);
  if (!turns) result.diabolo_orientation = {};
  return result;
}

/// The states of each stretch of each take.
using Played = std::vector<std::vector<std::vector<State<double>>>>;

/// Whether the simulator says where the axle points.
inline bool knows_axle(const Played& played) {
  for (const auto& take : played)
    for (const auto& states : take)
      if (!std::ranges::all_of(states, [](const auto& state) { return state.axis.allFinite(); }))
        return false;
  return true;
}

/// Lets a simulator play all of it.
inline Played play(const std::vector<TakeToPlay>& takes, const Simulate& simulate) {
  Played played;
  for (const TakeToPlay& take : takes) {
    played.emplace_back();
    for (const Stretch& stretch : take.stretches) {
      played.back().push_back(simulate(stretch.start, tips_of(take, stretch), row_times(take, stretch)));
      check_played(played.back().back(), take, stretch);
    }
  }
  return played;
}

/// The answer about a simulator that was asked to play nothing: no stretch of the recordings is long enough.
inline Diagnosis nothing_played() {
  Diagnosis d;
  d.headline = Headline::kInsufficientData;
  d.reason = "nothing was played, since no stretch of the recordings is long enough to be";
  d.sentence = "Nothing can be concluded: " + d.reason + ".";
  return d;
}

/// The recordings that a camera in the simulator would have made; a take without a stretch gives none.
inline std::vector<Recording> played_takes(const std::vector<TakeToPlay>& takes, const Played& played) {
  std::vector<Recording> result;
  for (std::size_t t = 0; t < takes.size(); ++t)
    if (!takes[t].stretches.empty()) result.push_back(with_diabolo(takes[t], played[t]));
  return result;
}

}  // namespace diabolo
