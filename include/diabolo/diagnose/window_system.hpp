// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "diabolo/diagnose/fit_model.hpp"

namespace diabolo {

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

  /// Root mean square of the position's residuals, one coordinate [m]; NaN where none is compared.
  double position_residual() const {
    return position_numbers > 0 ? std::sqrt(position_square / position_numbers) : kNaN;
  }
};

namespace diagnose_detail {

/// Makes the system of a window, residual by residual.
template <class D>
class WindowSums {
 public:
  WindowSums(const std::vector<int>& columns, Eigen::Index rows)
      : columns_(columns),
        n_(static_cast<Eigen::Index>(columns.size())),
        line_(n_ + 1),
        positions_(Eigen::MatrixXd::Zero(n_ + 1, n_ + 1)),
        spins_(positions_) {
    system_.residuals.setConstant(3, rows, kNaN);
    system_.spin_residuals.setConstant(rows, kNaN);
  }

  /// `row` counts from the window's first.
  void add_position(Eigen::Index row, const Vector3<double>& seen, const Vector3<D>& predicted) {
    for (int c = 0; c < 3; ++c) {
      const double residual = add(positions_, seen[c], predicted[c]);
      system_.position_square += residual * residual;
      system_.residuals(c, row) = residual;
      ++system_.position_numbers;
    }
  }

  void add_spin(Eigen::Index row, double seen, const D& predicted) {
    const double residual = add(spins_, seen, predicted);
    system_.spin_square += residual * residual;
    system_.spin_residuals[row] = residual;
    ++system_.spin_numbers;
  }

  void add_lost(int numbers) { system_.lost = numbers; }

  /// Sizes are stated for half a second, as under a constant acceleration; the first time after it counts.
  void measure_reach(double seconds, const State<D>& state) {
    if (reached_) return;
    reached_ = true;
    for (Eigen::Index i = kStartUnknowns; i < n_; ++i) {
      const int u = columns_[static_cast<std::size_t>(i)] - kStartUnknowns;
      double square = 0.0;
      for (int c = 0; c < 3; ++c) square += std::pow(state.position[c].gradient[i], 2);
      system_.reach[u] = std::sqrt(square) * std::min(1.5, std::pow(0.5 / seconds, 2));
      system_.spin_reach[u] = std::abs(state.spin.gradient[i]) * std::min(1.5, 0.5 / seconds);
    }
  }

  WindowSystem finish(double spin) && {
    system_.numbers = system_.position_numbers + system_.spin_numbers;
    system_.spin = std::abs(spin);
    system_.failed = !positions_.allFinite() || !spins_.allFinite();
    std::vector<int> columns = columns_;
    columns.push_back(kWindowColumns - 1);
    system_.positions(columns, columns) =
        Eigen::MatrixXd(positions_.template selfadjointView<Eigen::Lower>());
    system_.spins(columns, columns) = Eigen::MatrixXd(spins_.template selfadjointView<Eigen::Lower>());
    return std::move(system_);
  }

 private:
  double add(Eigen::MatrixXd& sums, double seen, const D& predicted) {
    const double residual = seen - predicted.value;
    for (Eigen::Index i = 0; i < n_; ++i) line_[i] = static_cast<double>(predicted.gradient[i]);
    line_[n_] = residual;
    sums.template selfadjointView<Eigen::Lower>().rankUpdate(line_);
    return residual;
  }

  const std::vector<int>& columns_;
  Eigen::Index n_;
  WindowSystem system_;
  Eigen::VectorXd line_;
  Eigen::MatrixXd positions_, spins_;  // of what is carried
  bool reached_ = false;
};

}  // namespace diagnose_detail

}  // namespace diabolo
