// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "diabolo/diagnose/smooth_tips.hpp"
#include "diabolo/diagnose/unknowns.hpp"
#include "diabolo/evaluate/start_state.hpp"
#include "diabolo/evaluate/windows.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"
#include "diabolo/recording/spin.hpp"
#include "diabolo/recording/stick_frames.hpp"
#include "diabolo/recording/tip_motion.hpp"
#include "diabolo/recording/track_noise.hpp"

namespace diabolo {

/// Rows over which the motion is predicted from a start of its own.
struct FitWindow {
  Eigen::Index first, last;  ///< both included
  State<double> start;       ///< the present estimate; spin about the axle as in State
};

/// The tips at an instant, and how they change with a shift of time, with the time constant of a lag, and
/// with offsets in the sticks' frames.
struct FitTips {
  Tips<double> tips;
  Vector3<double> left_acceleration, right_acceleration;                                          ///< [m/s^2]
  Vector3<double> left_by_lag = Vector3<double>::Zero(), right_by_lag = Vector3<double>::Zero();  ///< [m/s]
  /// Derivatives of the velocities [m/s^2].
  Vector3<double> left_velocity_by_lag = Vector3<double>::Zero(),
                  right_velocity_by_lag = Vector3<double>::Zero();
  Eigen::Matrix3d left_frame, right_frame;            ///< stick to world
  Eigen::Matrix3d left_frame_rate, right_frame_rate;  ///< their derivatives [1/s]
};

/// A recording, made ready for a diagnosis. All fits share it.
struct Take {
  Recording recording;              ///< tips smoothed, edges of dropouts taken out
  Eigen::VectorXd times;            ///< of the rows [s]
  Spin spin;                        ///< between each row and the next
  Eigen::Matrix3Xd axis;            ///< of the axle in each row
  std::vector<StringState> states;  ///< as guessed
  std::shared_ptr<const TipMotion<double>> motion;
  std::vector<Eigen::Matrix3d> left_frames, right_frames;  ///< of the sticks in each row, to the world
  int substeps = 4;                                        ///< per row; see also steps_for_spring()
  TrackNoise left_noise, right_noise, diabolo_noise;       ///< as the camera gave them
  double growth = 1.0;                                     ///< growth_of_differences() of the diabolo's track
  double angle_noise = 0.0;                                ///< [rad]
  bool has_spin = false, has_orientation = false;
};

/// A take, and the windows that a fit predicts of it.
struct FitTake {
  std::shared_ptr<const Take> take;
  std::vector<FitWindow> windows;
};

/// Whether anybody saw the diabolo turn.
inline bool has_spin(const FitTake& fit_take) { return fit_take.take->has_spin; }

/// Whether the string goes from one state to another in a window.
inline bool changes_state(const Take& take, const FitWindow& window) {
  const auto begin = take.states.begin() + window.first, end = take.states.begin() + window.last + 1;
  return std::any_of(begin, end, [&](StringState state) { return state != *begin; });
}

/// Length of a window [s].
inline constexpr double kFitWindow = 0.5;
/// Longest step of the simulation in a diagnosis [s].
inline constexpr double kFitStep = 4.2e-3;

/// Cuts the rows into windows of about kFitWindow that begin where the string's state is not about to change.
inline std::vector<FitWindow> fit_windows(const Take& take) {
  const Recording& r = take.recording;
  const Eigen::Index size = r.size(), wanted = std::max<Eigen::Index>(6, std::lround(kFitWindow * r.rate)),
                     margin = std::max<Eigen::Index>(2, std::lround(0.035 * r.rate));
  const std::vector<bool> left = in_long_gap(r.left, take.times), right = in_long_gap(r.right, take.times);
  const Velocity centred =
      velocity(r, r.diabolo,
               local_polynomial(std::max(5, static_cast<int>(2 * margin + 1)), 2, FilterWindow::kCentred));
  const auto row_ok = [&](Eigen::Index i) {
    const std::size_t k = static_cast<std::size_t>(i);
    return !left[k] && !right[k] && r.steps_evenly(i);
  };
  const auto start_ok = [&](Eigen::Index i) {
    if (i < margin || i + margin >= size || !row_ok(i) || !centred.valid[i]) return false;
    for (Eigen::Index j = i - margin; j <= i + margin; ++j)
      if (take.states[static_cast<std::size_t>(j)] != take.states[static_cast<std::size_t>(i)]) return false;
    return true;
  };
  std::vector<FitWindow> windows;
  for (Eigen::Index i = 0; i < size;) {
    if (!start_ok(i)) {
      ++i;
      continue;
    }
    Eigen::Index last = i;
    while (last + 1 < size && last - i < wanted && row_ok(last)) ++last;
    // Up to the next start, if that is near.
    for (Eigen::Index j = last; j < std::min(size, i + wanted + wanted / 3) && last - i >= wanted; ++j) {
      if (!row_ok(j)) break;
      if (!start_ok(j)) continue;
      last = j;
      break;
    }
    const Eigen::Index rows = last - i + 1;
    if (rows >= wanted / 2 && r.diabolo.valid.segment(i, rows).count() * 10 >= rows * 6) {
      FitWindow window{i, last, {}};
      window.start.position = r.diabolo.position.col(i);
      window.start.velocity = centred.velocity.col(i);
      window.start.string_state = take.states[static_cast<std::size_t>(i)];
      for (Eigen::Index j = i; j < std::min(size, i + 10); ++j)
        if (take.spin.valid[j]) {
          window.start.spin = take.spin.value[j];
          break;
        }
      windows.push_back(window);
    }
    i = std::max(last, i + 1);
  }
  return windows;
}

/// Makes a recording ready. Throws RecordingError where the tips are never seen together.
inline FitTake make_fit_take(const Recording& given) {
  const auto made = std::make_shared<Take>();
  Take& take = *made;
  take.recording = without_dropout_edges(given);
  take.left_noise = track_noise(take.recording.left);
  take.right_noise = track_noise(take.recording.right);
  take.diabolo_noise = track_noise(take.recording.diabolo);
  take.growth = growth_of_differences(take.recording.diabolo, given.rate);
  take.recording.left = smoothed(given.left, given.rate);
  take.recording.right = smoothed(given.right, given.rate);
  const RecordedTips tips(take.recording, Interpolation::kSpline);
  take.times = tips.times();
  take.motion = tips.motion(0, given.size() - 1);
  take.spin = signed_spin(take.recording);
  take.has_spin = take.spin.valid.any();
  take.angle_noise = angle_noise(take.spin.value, take.spin.valid, given.rate);
  take.has_orientation = !given.diabolo_orientation.empty() && given.diabolo_orientation.valid.any();
  take.axis = axes(take.recording);
  take.left_frames = stick_frames(take.recording.left_orientation, given.size());
  take.right_frames = stick_frames(take.recording.right_orientation, given.size());
  Recording guessed = take.recording;
  if (const std::optional<double> usual = usual_path_length(take.recording)) guessed.string_length = *usual;
  take.states = guess_string_states(guessed);
  take.substeps = std::max(1, static_cast<int>(std::ceil(1.0 / (given.rate * kFitStep))));
  return {made, fit_windows(take)};
}

/// Shortest time constant of a lag that is told from none [s].
inline constexpr double kShortestLag = 3e-4;

/// The time constant of a kFilter or kServo [s].
inline double lag_of(const UnknownVector& at) { return std::max(kShortestLag, at[index_of(Unknown::kLag)]); }

/// Lets the tips follow the given ones as s' = (c - s) / tau; exact for a c that is straight between the
/// substeps.
inline void lag_behind(std::vector<FitTips>& grid, double step, double tau) {
  const auto follow = [&](auto tip, double lag) {
    std::vector<Vector3<double>> result;
    const double keep = std::exp(-step / lag);
    Vector3<double> s = tip(grid.front()) - lag * (tip(grid[1]) - tip(grid.front())) / step;
    for (std::size_t k = 0; k < grid.size(); ++k) {
      result.push_back(s);
      if (k + 1 == grid.size()) break;
      const Vector3<double> here = tip(grid[k]), slope = (tip(grid[k + 1]) - here) / step;
      s = keep * s + (1.0 - keep) * here + slope * (step - lag * (1.0 - keep));
    }
    return result;
  };
  const auto left = [](const FitTips& s) { return s.tips.left; };
  const auto right = [](const FitTips& s) { return s.tips.right; };
  const double more = tau * 1.001;
  const std::vector<Vector3<double>> l = follow(left, tau), r = follow(right, tau), l2 = follow(left, more),
                                     r2 = follow(right, more);
  for (std::size_t k = 0; k < grid.size(); ++k) {
    FitTips& out = grid[k];
    const Vector3<double> left_velocity = (out.tips.left - l[k]) / tau,
                          right_velocity = (out.tips.right - r[k]) / tau;
    out.left_acceleration = (out.tips.left_velocity - left_velocity) / tau;
    out.right_acceleration = (out.tips.right_velocity - right_velocity) / tau;
    out.tips.left = l[k];
    out.tips.right = r[k];
    out.tips.left_velocity = left_velocity;
    out.tips.right_velocity = right_velocity;
    out.left_by_lag = (l2[k] - l[k]) / (more - tau);
    out.right_by_lag = (r2[k] - r[k]) / (more - tau);
    out.left_velocity_by_lag = -(left_velocity + out.left_by_lag) / tau;
    out.right_velocity_by_lag = -(right_velocity + out.right_by_lag) / tau;
  }
}

/// After so many of its time constants a lag has forgotten what it began with, to the last digit.
inline constexpr double kForgotten = 40.0;

/// Tips at each of so many substeps from row `first` to row `last`, read at the recorded time plus the time
/// offset, as kServo lagging behind the recorded ones, less the tip offsets.
inline std::vector<FitTips> tips_of_take(const Take& take, const UnknownVector& at, Eigen::Index first,
                                         Eigen::Index last, int substeps, Delay delay = Delay::kClock) {
  const bool lags = delay == Delay::kServo && last > first;
  const double tau = lag_of(at), rate = take.recording.rate;
  const Eigen::Index lead = lags ? static_cast<Eigen::Index>(std::ceil(kForgotten * tau * rate)) : 0,
                     begin = std::max<Eigen::Index>(0, first - lead);
  const double clock = at[index_of(Unknown::kTimeOffset)];
  const Vector3<double> left_offset = at.segment<3>(index_of(Unknown::kLeftX)),
                        right_offset = at.segment<3>(index_of(Unknown::kRightX));
  std::vector<FitTips> result(static_cast<std::size_t>((last - begin) * substeps + 1));
  std::size_t hint = 0, hint_before = 0, hint_after = 0;
  for (Eigen::Index i = begin, k = 0; i <= last; ++i)
    for (int s = 0; s < (i < last ? substeps : 1); ++s, ++k) {
      FitTips& out = result[static_cast<std::size_t>(k)];
      const double fraction = static_cast<double>(s) / substeps;
      const Eigen::Index next = std::min(i + 1, take.times.size() - 1);
      const double gap = std::max(take.times[next] - take.times[i], 1e-6);
      const double time = take.times[i] + fraction * gap + clock, h = 5e-4;
      out.tips = take.motion->at(time, hint);
      const Tips<double> before = take.motion->at(time - h, hint_before),
                         after = take.motion->at(time + h, hint_after);
      out.left_acceleration = (after.left_velocity - before.left_velocity) / (2.0 * h);
      out.right_acceleration = (after.right_velocity - before.right_velocity) / (2.0 * h);
      const std::size_t a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(next);
      out.left_frame = take.left_frames[a] * (1.0 - fraction) + take.left_frames[b] * fraction;
      out.right_frame = take.right_frames[a] * (1.0 - fraction) + take.right_frames[b] * fraction;
      out.left_frame_rate = (take.left_frames[b] - take.left_frames[a]) / gap;
      out.right_frame_rate = (take.right_frames[b] - take.right_frames[a]) / gap;
    }
  if (lags) lag_behind(result, 1.0 / (rate * substeps), tau);
  result.erase(result.begin(), result.begin() + (first - begin) * substeps);
  for (FitTips& out : result) {
    out.tips.left -= out.left_frame * left_offset;
    out.tips.right -= out.right_frame * right_offset;
    out.tips.left_velocity -= out.left_frame_rate * left_offset;
    out.tips.right_velocity -= out.right_frame_rate * right_offset;
  }
  return result;
}

}  // namespace diabolo
