// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "diabolo/diagnose/window_system.hpp"

namespace diabolo {

/// Of the string on the diabolo [m/s^2]: beyond, it is the jerk of a string that came taut.
inline constexpr double kHardestPull = 60.0;

namespace diagnose_detail {

/// A low pass of time constant `lag` after a step in which its input goes straight from `from` to `to`.
template <class D>
Vector3<D> low_passed(const Vector3<D>& y, const Vector3<D>& from, const Vector3<D>& to, const D& dt,
                      const D& lag) {
  using std::exp;
  const D kept = exp(-dt / lag), share = lag * (D(1.0) - kept) / dt;
  return y * kept + from * D(share - kept) + to * D(D(1.0) - share);
}

/// Body to world.
inline Eigen::Matrix3d frame_of(const OrientationTrack& track, Eigen::Index row) {
  return Eigen::Quaterniond(Eigen::Vector4d(track.quaternion.col(row))).toRotationMatrix();
}

/// The same where it is first seen in a window; zero where it never is.
inline Eigen::Matrix3d first_frame(const Take& take, const FitWindow& window) {
  const OrientationTrack& track = take.recording.diabolo_orientation;
  for (Eigen::Index row = window.first; take.has_orientation && row <= window.last; ++row)
    if (track.valid[row]) return frame_of(track, row);
  return Eigen::Matrix3d::Zero();
}

/// Moves a centre to where the markers say that it is, in a body that lies as `frame`.
template <class D>
void move_to_marker(Vector3<D>& centre, const Eigen::Matrix3d& frame, const DualUnknowns<D>& x) {
  for (int j = 0; j < 3; ++j) {
    const D offset = x(static_cast<Unknown>(index_of(Unknown::kMarkerX) + j));
    for (int c = 0; c < 3; ++c) centre[c] = centre[c] + offset * D(frame(c, j));
  }
}

/// What a filter makes of the diabolo's track: y' = (x - y) / tau, begun with what was recorded; without one
/// the track as it is.
template <class D>
class FilteredTrack {
 public:
  FilteredTrack(const Vector3<double>& begin, const DualUnknowns<D>& x, Delay delay)
      : filters_(delay == Delay::kFilter),
        lag_(D(lag_of(x.at)) + (x(Unknown::kLag) - D(x.at[index_of(Unknown::kLag)]))),
        trail_(begin.template cast<D>()) {}

  /// The next centre, `seconds` after the one before; the first begins.
  Vector3<D> next(const Vector3<D>& centre, double seconds, bool first) {
    if (!filters_) return centre;
    if (!first) trail_ = low_passed(trail_, before_, centre, D(seconds), lag_);
    before_ = centre;
    return trail_;
  }

 private:
  bool filters_;
  D lag_;
  Vector3<D> before_, trail_;
};

/// Whether the diabolo is seen below the string while the prediction still flies: a catch that it missed.
template <class D>
bool missed_catch(const State<D>& state, const Vector3<double>& seen, const Tips<double>& tips) {
  return state.string_state == StringState::kFlying && height_above_tips(seen, tips.left, tips.right) < -0.02;
}

/// How much shorter than at rest the string is per newton, as it is moved by its mean stretch.
template <class D>
D mean_stretch(const FitModel<D>& model, const DualUnknowns<D>& x) {
  if (is_dynamic(model.give)) return D(0.0);
  return (x(Unknown::kCompliance) + x(Unknown::kStickCompliance) * D(2.0)) * model.parameters.mass;
}

}  // namespace diagnose_detail

/// Predicts a window and compares it with the recording, with derivatives by its start and the unknowns that
/// are carried; by the others they are told to be zero.
template <class D>
WindowSystem window_system(const Take& take, const FitWindow& window,
                           const diagnose_detail::FitModel<D>& model,
                           const diagnose_detail::DualUnknowns<D>& x, Delay delay = Delay::kClock,
                           bool bounces = false) {
  const Recording& r = take.recording;
  diagnose_detail::WindowSums<D> sums(x.columns, window.last - window.first + 1);
  const double usual = diagnose_detail::usual_pull(r, window);
  const D stretch = diagnose_detail::mean_stretch(model, x);
  Parameters<D> parameters = model.parameters;
  parameters.string_length = parameters.string_length + stretch * D(usual);
  using FitPredictor = diagnose_detail::FitPredictor<D>;
  const FitPredictor predictor(parameters, model.effects, typename FitPredictor::AlreadyValid{});
  const int substeps = take.substeps * diagnose_detail::steps_for_spring(model.give);
  FitWindow begun = window;
  begun.start.axis = take.axis.col(window.first);
  const std::vector<FitTips> grid = tips_of_take(take, x.at, window.first, window.last, substeps, delay);
  const auto tips_at = [&](Eigen::Index k) {
    return diagnose_detail::fit_tips(grid[static_cast<std::size_t>(k)], x);
  };
  Eigen::Index k = 0;
  Tips<D> now = tips_at(k), next = tips_at(k + 1);
  const auto step_of = [&](Eigen::Index row) {
    return D((take.times[row + 1] - take.times[row]) / substeps);
  };
  State<D> state = diagnose_detail::fit_start(begun, predictor, now, next, step_of(window.first), bounces);
  const double begin = take.times[window.first];
  diagnose_detail::FilteredTrack<D> track(r.diabolo.position.col(window.first), x, delay);
  Eigen::Matrix3d frame = diagnose_detail::first_frame(take, window);  ///< body to world, as last seen
  D spin_before = state.spin;
  for (Eigen::Index row = window.first; row <= window.last; ++row) {
    const bool turned = take.has_orientation && r.diabolo_orientation.valid[row], first = row == window.first;
    if (turned) frame = diagnose_detail::frame_of(r.diabolo_orientation, row);
    Vector3<D> centre = state.position;
    const double pull = value_of(squared_norm(state.string_acceleration));
    if (state.string_state == StringState::kOnString && pull > 0.0 && pull < kHardestPull * kHardestPull)
      centre = centre + diagnose_detail::string_shift(state, now, stretch, usual);
    diagnose_detail::move_to_marker(centre, frame, x);
    centre = track.next(centre, first ? 0.0 : take.times[row] - take.times[row - 1], first);
    if (r.diabolo.valid[row]) {
      const Vector3<double> seen = r.diabolo.position.col(row);
      if (diagnose_detail::missed_catch(state, seen, grid[static_cast<std::size_t>(k)].tips)) {
        // What follows says nothing of the motion before it.
        sums.add_lost(3 * static_cast<int>(r.diabolo.valid.segment(row, window.last - row + 1).count()));
        break;
      }
      // (What a filtered track begins with is taken from the first row, which then says nothing; nor may it
      // under another delay, which is compared with this one.)
      if ((!take.has_orientation || turned) && !first) sums.add_position(row - window.first, seen, centre);
    }
    if (!first && take.spin.valid[row - 1])
      sums.add_spin(row - window.first, take.spin.value[row - 1], (spin_before + state.spin) * D(0.5));
    if (row == window.last || take.times[row] >= begin + 0.5)
      sums.measure_reach(std::max(take.times[row] - begin, 1e-3), state);
    if (row == window.last) break;
    spin_before = state.spin;
    for (int s = 0; s < substeps; ++s, ++k) {
      next = tips_at(k + 1);
      predictor.step(state, now, next, step_of(row));
      now = next;
    }
    state.axis = take.axis.col(row + 1).cast<D>();
  }
  return std::move(sums).finish(state.spin.value);
}

}  // namespace diabolo
