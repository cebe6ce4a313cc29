// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "diabolo/diagnose/refine.hpp"

namespace diabolo::diagnose_detail {

/// Springs that are tried: gives [m/N] from stiff twine to a robot's holders, dampings [N s/m].
inline constexpr double kTriedGives[] = {2e-4, 5e-4, 1.2e-3, 3e-3, 8e-3, 2e-2};
inline constexpr double kTriedDampings[] = {2.0, 10.0};

/// A spring under which the windows, as they stand, leave less than this share is worth a fit of its own.
inline constexpr double kPromising = 0.8;

/// The string's pull at rest over mass, the mean of all windows [m/s^2].
inline double usual_pull(const std::vector<FitTake>& fit_takes) {
  double sum = 0.0;
  for (const FitTake& fit_take : fit_takes)
    for (const FitWindow& window : fit_take.windows) sum += usual_pull(fit_take.take->recording, window);
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

/// The fit with the spring in place of its own that leaves least, all else as it is, the string shorter by
/// what hangs on the spring; nothing where none promises much. (Beyond the right spring's valley a bounce is
/// out of step, and no derivative shows the way.)
template <class D>
std::optional<Fit> another_spring(const Fit& fit, const ActiveSet& set, const Model& physics, int threads,
                                  const FitWatch& watch) {
  const bool in_string = set[index_of(Unknown::kCompliance)];
  if (watch.is_enough() || !(in_string || set[index_of(Unknown::kStickCompliance)])) return std::nullopt;
  const int give = index_of(in_string ? Unknown::kCompliance : Unknown::kStickCompliance);
  const int damping = index_of(in_string ? Unknown::kDamping : Unknown::kStickDamping);
  const double weight = usual_pull(fit.fit_takes) *
                        parameters_for(physics, fit.fit_takes.front().take->recording).mass *
                        (in_string ? 1.0 : 2.0);
  std::optional<Fit> best;
  for (const double tried_give : kTriedGives)
    for (const double tried_damping : kTriedDampings) {
      Fit trial = fit;
      trial.noise_is_known = true;
      trial.at[give] = tried_give;
      trial.at[damping] = tried_damping;
      trial.at[index_of(Unknown::kStringLength)] -= weight * (tried_give - fit.at[give]);
      linearize<D>(trial, physics, ActiveSet::Constant(false), threads, watch);
      if (trial.cost < (best ? best->cost : kPromising * fit.cost)) best = std::move(trial);
    }
  if (best) best->noise_is_known = fit.noise_is_known;
  return best;
}

}  // namespace diabolo::diagnose_detail
