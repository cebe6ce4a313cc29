// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "diabolo/diagnose/corrected.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/fit.hpp"

namespace diabolo {

/// Of one window, the sums for the gain that turns its axle: recorded against predicted for a gain of one,
/// each less its mean, since the start of the axle is not known either.
struct AxleWindow {
  double product = 0.0, square = 0.0;
};

/// Predicts a window's axle and compares it with the recorded one.
inline AxleWindow axle_window(const FitTake& fit_take, const TipMotion<double>& motion,
                              const FitWindow& window, const FullPredictor<double>& predictor, double scale) {
  State<double> state = window.start;
  state.position /= scale;
  state.velocity /= scale;
  state.axis = fit_take.take->axis.col(window.first);
  const Vector3<double> begin = state.axis;
  Eigen::Matrix3Xd predicted(3, window.last - window.first + 1), seen = predicted;
  Eigen::Index rows = 0;
  std::size_t hint = 0;
  Tips<double> now = motion.at(fit_take.take->times[window.first], hint);
  for (Eigen::Index row = window.first; row <= window.last; ++row) {
    if (fit_take.take->recording.diabolo_orientation.valid[row]) {
      predicted.col(rows) = state.axis - begin;
      seen.col(rows++) = fit_take.take->axis.col(row);
    }
    if (row == window.last) break;
    const double dt = (fit_take.take->times[row + 1] - fit_take.take->times[row]) / fit_take.take->substeps;
    for (int s = 1; s <= fit_take.take->substeps; ++s) {
      const Tips<double> next = motion.at(fit_take.take->times[row] + s * dt, hint);
      predictor.step(state, now, next, dt);
      now = next;
    }
  }
  if (rows < 2 || !predicted.allFinite()) return {};
  const Eigen::Matrix3Xd a = predicted.leftCols(rows).colwise() - predicted.leftCols(rows).rowwise().mean(),
                         b = seen.leftCols(rows).colwise() - seen.leftCols(rows).rowwise().mean();
  return {a.cwiseProduct(b).sum(), a.squaredNorm()};
}

/// What the recorded direction of the axle, which no other candidate moves, says of GyroscopicTilt. It moves
/// the diabolo by far less than any floor, so that it is seen and never claimed.
inline Finding find_axle_motion(const Fit& fit, const Model& found) {
  std::vector<AxleWindow> windows;
  double product = 0.0, square = 0.0;
  const double scale = 1.0 + fit.at[index_of(Unknown::kLengthScale)];
  Model turning = found;
  turning.effects.get<GyroscopicTilt>().gain = 1.0;
  std::size_t first = 0;  // of the take's windows among all
  for (const FitTake& fit_take : fit.fit_takes) {
    const std::size_t begin = std::exchange(first, first + fit_take.windows.size());
    if (!fit_take.take->has_orientation || !fit_take.take->has_spin) continue;
    const Recording recording = corrected(fit_take.take->recording, fit.at);
    const FullPredictor<double> predictor(parameters_for(turning, recording), turning.effects);
    const auto motion = RecordedTips(recording, Interpolation::kSpline).motion(0, recording.size() - 1);
    for (std::size_t w = 0; w < fit_take.windows.size(); ++w) {
      if (fit.scores[begin + w].weight < 1.0) continue;  // its motion is not explained
      windows.push_back(axle_window(fit_take, *motion, fit_take.windows[w], predictor, scale));
      product += windows.back().product;
      square += windows.back().square;
    }
  }
  Finding f;
  f.candidate = &candidate_of("gyroscopic_tilt");
  const double gain = square > 0.0 ? product / square : 0.0;
  double spread = 0.0;  // by the jackknife over windows
  for (const AxleWindow& w : windows)
    if (square - w.square > 0.0) spread += std::pow((product - w.product) / (square - w.square) - gain, 2);
  const int u = index_of(Unknown::kGyroscopicGain);
  f.estimate[u] = gain;
  f.deviation[u] = std::sqrt(spread);
  f.z = spread > 0.0 ? gain / f.deviation[u] : 0.0;
  f.p_value = family_wise(f.z);
  f.sure = speaks_for(*f.candidate, f.z);
  f.reason = f.sure ? "there, but too small to matter" : "too small to be told from nothing";
  return f;
}

}  // namespace diabolo
