// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "diabolo/diagnose/fit_model.hpp"

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

}  // namespace diagnose_detail

/// Columns: start, unknowns, residual.
inline constexpr int kWindowColumns = kStartUnknowns + kUnknowns + 1;
using WindowMatrix = Eigen::MatrixXd;  ///< kWindowColumns x kWindowColumns

/// What one window says, in the scales of kUnknownInfos and kStartScales.
struct WindowSystem {
  /// [J r]^T [J r] of the positions [m] and of the spin [rad/s]; r = recorded - predicted.
  WindowMatrix positions = WindowMatrix::Zero(kWindowColumns, kWindowColumns),
               spins = WindowMatrix::Zero(kWindowColumns, kWindowColumns);
  int numbers = 0;                                  ///< residuals in it
  int lost = 0;                                     ///< residuals after a catch that the prediction missed
  double position_square = 0.0, spin_square = 0.0;  ///< sums of squared residuals [m^2], [rad^2/s^2]
  int position_numbers = 0, spin_numbers = 0;
  /// Recorded less predicted, row by row of the window: position [m], and spin before the row [rad/s]. NaN
  /// where nothing is compared.
  Eigen::Matrix3Xd residuals;
  Eigen::VectorXd spin_residuals;
  UnknownVector reach = UnknownVector::Zero();       ///< displacement at the window's end per unknown [m]
  UnknownVector spin_reach = UnknownVector::Zero();  ///< the same of the spin [rad/s]
  double spin = 0.0;                                 ///< size of the spin [rad/s]
  bool failed = false;                               ///< the prediction left the world

  /// Root mean square of the position's residuals, one coordinate [m].
  double position_residual() const { return std::sqrt(position_square / std::max(1, position_numbers)); }
};

/// Predicts a window and compares it with the recording, with derivatives by its start and the unknowns that
/// are carried; by the others they are told to be zero.
template <class D>
WindowSystem window_system(const Take& take, const FitWindow& window,
                           const diagnose_detail::FitModel<D>& model,
                           const diagnose_detail::DualUnknowns<D>& x, Delay delay = Delay::kClock,
                           bool bounces = false) {
  const Eigen::Index n = static_cast<Eigen::Index>(x.columns.size());
  const Recording& r = take.recording;
  WindowSystem system;
  system.residuals.setConstant(3, window.last - window.first + 1, kNaN);
  system.spin_residuals.setConstant(window.last - window.first + 1, kNaN);
  const double usual = diagnose_detail::usual_pull(r, window);
  const D stretch =
      diagnose_detail::dynamic_spring(x.at)
          ? D(0.0)
          : D((x(Unknown::kCompliance) + x(Unknown::kStickCompliance) * D(2.0)) * model.parameters.mass);
  Parameters<D> parameters = model.parameters;
  parameters.string_length = parameters.string_length + stretch * D(usual);
  using FitPredictor = diagnose_detail::FitPredictor<D>;
  const FitPredictor predictor(parameters, model.effects, typename FitPredictor::AlreadyValid{});
  FitWindow begun = window;
  begun.start.axis = take.axis.col(window.first);
  const std::vector<FitTips> grid = tips_of_take(take, x.at, window.first, window.last, delay);
  const auto tips_at = [&](Eigen::Index k) {
    return diagnose_detail::fit_tips(grid[static_cast<std::size_t>(k)], x);
  };
  Eigen::Index k = 0;
  Tips<D> now = tips_at(k), next = tips_at(k + 1);
  const auto step_of = [&](Eigen::Index row) {
    return D((take.times[row + 1] - take.times[row]) / take.substeps);
  };
  State<D> state = diagnose_detail::fit_start(begun, predictor, now, next, step_of(window.first), bounces);
  const double half = take.times[window.first] + 0.5;
  bool measured_reach = false;
  // A low pass of the diabolo's track: y' = (x - y) / tau, begun with what was recorded.
  const bool filtered = delay == Delay::kFilter;
  const D lag = D(lag_of(x.at)) + (x(Unknown::kLag) - D(x.at[index_of(Unknown::kLag)]));
  Vector3<D> centre_before, trail = r.diabolo.position.col(window.first).template cast<D>();
  Eigen::Matrix3d frame = diagnose_detail::first_frame(take, window);  ///< body to world, as last seen
  Eigen::VectorXd line(n + 1);
  Eigen::MatrixXd positions = Eigen::MatrixXd::Zero(n + 1, n + 1), spins = positions;  // of what is carried
  D spin_before = state.spin;
  for (Eigen::Index row = window.first; row <= window.last; ++row) {
    const bool turned = take.has_orientation && r.diabolo_orientation.valid[row];
    if (turned) frame = diagnose_detail::frame_of(r.diabolo_orientation, row);
    Vector3<D> centre = state.position;
    const double pull = value_of(squared_norm(state.string_acceleration));
    if (state.string_state == StringState::kOnString && pull > 0.0 && pull < kHardestPull * kHardestPull)
      centre = centre + diagnose_detail::string_shift(state, now, stretch, usual);
    diagnose_detail::move_to_marker(centre, frame, x);
    if (filtered) {
      if (row > window.first)
        trail = diagnose_detail::low_passed(trail, centre_before, centre,
                                            D(take.times[row] - take.times[row - 1]), lag);
      centre_before = centre;
      centre = trail;
    }
    if (r.diabolo.valid[row]) {
      // A catch that the prediction missed: what follows says nothing of the motion before it.
      const Vector3<double> seen = r.diabolo.position.col(row);
      if (state.string_state == StringState::kFlying &&
          height_above_tips(seen, grid[static_cast<std::size_t>(k)].tips.left,
                            grid[static_cast<std::size_t>(k)].tips.right) < -0.02) {
        system.lost = 3 * static_cast<int>(r.diabolo.valid.segment(row, window.last - row + 1).count());
        break;
      }
      // (What a filtered track begins with is taken from the first row, which then says nothing; nor may it
      // under another delay, which is compared with this one.)
      const bool known = (!take.has_orientation || turned) && row > window.first;
      for (int c = 0; c < 3 && known; ++c) {
        const double residual = seen[c] - centre[c].value;
        line.head(n) = centre[c].gradient.head(n).matrix().template cast<double>();
        line[n] = residual;
        positions.selfadjointView<Eigen::Lower>().rankUpdate(line);
        system.position_square += residual * residual;
        system.residuals(c, row - window.first) = residual;
        ++system.position_numbers;
      }
    }
    if (row > window.first && take.spin.valid[row - 1]) {
      const D mean = (spin_before + state.spin) * D(0.5);
      double residual = take.spin.value[row - 1] - mean.value;
      line.head(n) = mean.gradient.head(n).matrix().template cast<double>();
      line[n] = residual;
      spins.selfadjointView<Eigen::Lower>().rankUpdate(line);
      system.spin_square += residual * residual;
      system.spin_residuals[row - window.first] = residual;
      ++system.spin_numbers;
    }
    if (!measured_reach && (row == window.last || take.times[row] >= half)) {
      measured_reach = true;
      const double seconds = std::max(take.times[row] - take.times[window.first], 1e-3);
      for (Eigen::Index i = kStartUnknowns; i < n; ++i) {
        const int u = x.columns[static_cast<std::size_t>(i)] - kStartUnknowns;
        double square = 0.0;
        for (int c = 0; c < 3; ++c) square += std::pow(state.position[c].gradient[i], 2);
        // To the half second that sizes are stated for, as under a constant acceleration.
        const double growth = std::min(1.5, std::pow(0.5 / seconds, 2));
        system.reach[u] = std::sqrt(square) * growth;
        system.spin_reach[u] = std::abs(state.spin.gradient[i]) * std::min(1.5, 0.5 / seconds);
      }
    }
    if (row == window.last) break;
    spin_before = state.spin;
    for (int s = 0; s < take.substeps; ++s, ++k) {
      next = tips_at(k + 1);
      predictor.step(state, now, next, step_of(row));
      now = next;
    }
    state.axis = take.axis.col(row + 1).cast<D>();
  }
  system.numbers = system.position_numbers + system.spin_numbers;
  system.spin = std::abs(state.spin.value);
  system.failed = !positions.allFinite() || !spins.allFinite();
  std::vector<int> columns = x.columns;
  columns.push_back(kWindowColumns - 1);
  system.positions(columns, columns) = Eigen::MatrixXd(positions.selfadjointView<Eigen::Lower>());
  system.spins(columns, columns) = Eigen::MatrixXd(spins.selfadjointView<Eigen::Lower>());
  return system;
}

}  // namespace diabolo
