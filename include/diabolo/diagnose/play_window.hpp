// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "diabolo/diagnose/fit_take.hpp"
#include "diabolo/diagnose/fitted_spring.hpp"
#include "diabolo/full_predictor.hpp"

namespace diabolo::diagnose_detail {

/// Plays a window with the steps of a fit: calls `visit(row, state, tips)` at each of its rows. `state` is
/// where the diabolo begins, and ends.
template <class Visit>
void play_window(const Take& take, const FitWindow& window, const TipMotion<double>& motion,
                 const FullPredictor<double>& predictor, State<double>& state, const Visit& visit) {
  const int substeps = take.substeps * steps_for_spring(give_of(predictor.effects()));
  std::size_t hint = 0;
  Tips<double> now = motion.at(take.times[window.first], hint);
  for (Eigen::Index row = window.first;; ++row) {
    visit(row, state, now);
    if (row == window.last) return;
    const double dt = (take.times[row + 1] - take.times[row]) / substeps;
    for (int k = 1; k <= substeps; ++k) {
      const Tips<double> next = motion.at(take.times[row] + k * dt, hint);
      predictor.step(state, now, next, dt);
      now = next;
    }
  }
}

}  // namespace diabolo::diagnose_detail
