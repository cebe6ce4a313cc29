// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "diabolo/diagnose/hidden_noise.hpp"
#include "diabolo/diagnose/judge_adequacy.hpp"
#include "diabolo/diagnose/refine.hpp"

namespace diabolo {

namespace diagnose_detail {

/// Adds noise as a track has it.
inline void add_noise(Track& track, const TrackNoise& noise, std::mt19937_64& generator) {
  for (int axis = 0; axis < 3; ++axis)
    track.position.row(axis) +=
        drawn_noise(track.valid.size(), noise.deviation[axis], noise.correlation[axis], generator);
}

/// Adds to a tip what smoothing leaves of noise as the camera gave it.
inline void add_smoothed_noise(Track& tip, const TrackNoise& noise, double rate, std::mt19937_64& generator) {
  Track drawn{Eigen::Matrix3Xd::Zero(3, tip.valid.size()), tip.valid};
  add_noise(drawn, noise, generator);
  tip.position += smoothed(drawn, rate).position;
}

/// The diabolo as the windows predict it: what they do not compare becomes a dropout.
inline void put_predicted(Take& take, const std::vector<FitWindow>& windows, const WindowSystem* systems) {
  for (const FitWindow& window : windows) {
    const WindowSystem& system = *systems++;
    for (Eigen::Index row = window.first + 1; row <= window.last; ++row) {
      const Eigen::Vector3d off = system.residuals.col(row - window.first);
      const double spin_off = system.spin_residuals[row - window.first];
      take.recording.diabolo.position.col(row) -= off;
      take.recording.diabolo.valid[row] = off.allFinite();
      take.spin.value[row - 1] -= spin_off;
      take.spin.valid[row - 1] = std::isfinite(spin_off);
    }
  }
}

/// The take as its camera would have filmed what a fit predicts.
inline std::shared_ptr<const Take> imagined(const Take& given, const std::vector<FitWindow>& windows,
                                            const WindowSystem* systems, std::mt19937_64& generator) {
  const auto made = std::make_shared<Take>(given);
  Take& take = *made;
  const double rate = take.recording.rate;
  if (take.growth > kHidden)
    take.diabolo_noise = noise_beside_motion(take.diabolo_noise, systems, windows.size(), rate, take.growth);
  put_predicted(take, windows, systems);
  add_noise(take.recording.diabolo, take.diabolo_noise, generator);
  add_smoothed_noise(take.recording.left, take.left_noise, rate, generator);
  add_smoothed_noise(take.recording.right, take.right_noise, rate, generator);
  take.motion = RecordedTips(take.recording, Interpolation::kSpline).motion(0, take.recording.size() - 1);
  const Eigen::Index turns = take.spin.value.size() - 1;
  const Eigen::VectorXd angle = drawn_noise(turns + 1, take.angle_noise, 0.0, generator);
  take.spin.value.head(turns) += rate * (angle.tail(turns) - angle.head(turns));
  return made;
}

/// Root mean square of what is seen; NaN where nothing is.
template <class Series>
double size_of_seen(const Series& series) {
  double sum = 0.0, count = 0.0;
  for (Eigen::Index i = 0; i < series.size(); ++i)
    if (std::isfinite(series[i])) sum += series[i] * series[i], count += 1.0;
  return count > 0.0 ? std::sqrt(sum / count) : kNaN;
}

}  // namespace diagnose_detail

/// The fit to takes as its own prediction and the camera's noise would make them: what it leaves, noise alone
/// leaves. Starts are fitted again, nothing else.
template <class D>
Fit noise_trial(const Fit& fit, const Model& physics, std::uint64_t seed, int threads,
                const FitWatch& watch) {
  std::mt19937_64 generator(seed);
  Fit trial = fit;
  trial.noise_is_known = true;
  std::size_t i = 0;
  for (FitTake& fit_take : trial.fit_takes) {
    fit_take.take = diagnose_detail::imagined(*fit_take.take, fit_take.windows, &fit.systems[i], generator);
    i += fit_take.windows.size();
  }
  approach<D>(trial, physics, ActiveSet::Constant(false), 3, threads, watch);
  return trial;
}

/// Notes in each window what the fit leaves and what noise alone leaves.
inline void note_noise(std::vector<WindowFinding>& windows, const Fit& fit, const Fit& trial) {
  using diagnose_detail::size_of_seen;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const WindowSystem &system = fit.systems[i], &noise = trial.systems[i];
    WindowFinding& found = windows[i];
    for (std::size_t k = 0; k < kMayChange.size(); ++k) {
      const int u = index_of(kMayChange[k].unknown);
      if (kMayChange[k].unknown == Unknown::kFriction && fit.at[u] == 0.0) continue;  // none, none changes
      found.slope[k] = fit.scores[i].score[u];
      found.curvature[k] = fit.scores[i].information(u, u);
    }
    found.residual_noise = noise.position_residual();
    found.spin_after = size_of_seen(system.spin_residuals);
    found.spin_noise = size_of_seen(noise.spin_residuals);
    for (int axis = 0; axis < 3; ++axis)
      found.beyond_noise[static_cast<std::size_t>(axis)] =
          std::pow(size_of_seen(system.residuals.row(axis)), 2) -
          std::pow(size_of_seen(noise.residuals.row(axis)), 2);
  }
}

/// What is left of a fit against what noise alone would leave; notes both in the windows. `ahead` is of
/// data left out.
template <class D>
Adequacy adequacy_of(std::vector<WindowFinding>& windows, const Fit& fit, const Model& physics,
                     const std::vector<ResidualAndNoise>& ahead, std::uint64_t seed, int threads,
                     const FitWatch& watch) {
  note_noise(windows, fit, noise_trial<D>(fit, physics, seed, threads, watch));
  std::vector<std::string> names;
  for (const FitTake& fit_take : fit.fit_takes) names.push_back(fit_take.take->recording.name);
  return judge_adequacy(windows, names, ahead);
}

}  // namespace diabolo
