// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "diabolo/diagnose/refine.hpp"

namespace diabolo::diagnose_detail {

/// A fit that ended stiff is tried on these: gives [m/N] of strings that ring, each half as stiff as the one
/// before, and dampings [N s/m]. Softer ones are found from kSoftStart. How long a string rings tells more of
/// it than how fast: the cost is nearly flat along the give, and halves where the damping is right.
inline constexpr double kTriedGives[] = {1.5e-4, 3e-4, 6e-4, 1.2e-3};
inline constexpr double kTriedDampings[] = {1.0, 3.0, 10.0};

/// A spring under which the windows, as they stand, cost less than this share is worth a fit of its own.
inline constexpr double kPromising = 0.8;

/// What gives where it is asked about: the string, else the sticks.
struct AskedSpring {
  int give, damping;  ///< unknowns
};
inline std::optional<AskedSpring> asked_spring(const ActiveSet& set) {
  if (set[index_of(Unknown::kCompliance)])
    return AskedSpring{index_of(Unknown::kCompliance), index_of(Unknown::kDamping)};
  if (set[index_of(Unknown::kStickCompliance)])
    return AskedSpring{index_of(Unknown::kStickCompliance), index_of(Unknown::kStickDamping)};
  return std::nullopt;
}

/// The string's tension at rest, the mean of all windows [N].
inline double mean_usual_tension(const std::vector<FitTake>& fit_takes, const Model& physics) {
  double sum = 0.0;
  for (const FitTake& fit_take : fit_takes) {
    const Recording& recording = fit_take.take->recording;
    const double mass = parameters_for(physics, recording).mass;
    for (const FitWindow& window : fit_take.windows) sum += mass * usual_pull(recording, window);
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, window_count(fit_takes)));
}

/// What `fit` costs with another one's noise.
inline double cost_with_noise_of(const Fit& other, Fit fit, int threads) {
  fit.noise = other.noise;
  fit.usual = other.usual;
  fit.noise_is_known = true;
  reweight(fit, threads);
  return fit.cost;
}

/// The fit with the spring in place of its own that costs least, all else as it is, the string shorter by
/// what hangs on the spring; nothing where none promises much. (Beyond the right spring's valley a bounce is
/// out of step, and no derivative shows the way.)
template <class D>
std::optional<Fit> another_spring(const Fit& fit, const ActiveSet& set, const Model& physics, int threads,
                                  const FitWatch& watch) {
  const std::optional<AskedSpring> asked = asked_spring(set);
  if (!asked) return std::nullopt;
  const double tension = mean_usual_tension(fit.fit_takes, physics);
  std::optional<Fit> best;
  for (const double tried_give : kTriedGives)
    for (const double tried_damping : kTriedDampings) {
      if (watch.is_enough()) return std::nullopt;
      Fit trial = fit;
      trial.noise_is_known = true;
      trial.at[index_of(Unknown::kCompliance)] = trial.at[index_of(Unknown::kStickCompliance)] = 0.0;
      trial.at[asked->give] = tried_give;
      trial.at[asked->damping] = tried_damping;
      trial.at[index_of(Unknown::kStringLength)] -= tension * (added_give(trial.at) - added_give(fit.at));
      linearize<D>(trial, physics, ActiveSet::Constant(false), threads, watch);
      if (trial.cost < (best ? best->cost : kPromising * fit.cost)) best = std::move(trial);
    }
  if (best) best->noise_is_known = fit.noise_is_known;
  return best;
}

}  // namespace diabolo::diagnose_detail
