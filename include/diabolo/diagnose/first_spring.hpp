// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/evidence.hpp"
#include "diabolo/diagnose/refine.hpp"
#include "diabolo/diagnose/select.hpp"

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

/// A fit as it stands to another one's noise.
inline Fit with_noise_of(const Fit& other, Fit fit, int threads) {
  fit.noise = other.noise;
  fit.usual = other.usual;
  fit.noise_is_known = true;
  reweight(fit, threads);
  return fit;
}

/// What `fit` costs with another one's noise.
inline double cost_with_noise_of(const Fit& other, const Fit& fit, int threads) {
  return with_noise_of(other, fit, threads).cost;
}

/// What two fits of the same windows cost, but for windows in which either misses a catch or is far off: by
/// how much it is says little.
inline std::pair<double, double> costs_where_both_fit(const Fit& a, const Fit& b) {
  std::pair<double, double> costs{a.cost, b.cost};
  for (std::size_t i = 0; i < a.scores.size(); ++i) {
    const auto fits = [i](const Fit& fit) { return fit.scores[i].weight == 1.0 && fit.systems[i].lost == 0; };
    if (fits(a) && fits(b)) continue;
    costs.first -= a.scores[i].cost;
    costs.second -= b.scores[i].cost;
  }
  return costs;
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

/// A fit that ended with less than this share of the give that it began with may have lost its bounce.
inline constexpr double kLostGive = 0.5;

/// Of a fit in which string and sticks gave together, and of which one is left free: the same where that
/// gives as much alone. (With less of a spring a bounce may be out of step, and no derivative shows the way
/// back.)
inline std::optional<Fit> giving_alone(Fit fit, const ActiveSet& free) {
  const double together = added_give(fit.at);
  put_at_rest(fit, free);
  const double lost = together - added_give(fit.at);
  const std::optional<AskedSpring> left = asked_spring(free);
  if (!left || !is_dynamic(together) || !(lost > 0.0)) return std::nullopt;
  fit.at[left->give] += left->give == index_of(Unknown::kCompliance) ? lost : 0.5 * lost;
  return fit;
}

/// The fit with string or sticks giving again, and what is free in it, where both were let go from `before`,
/// in which a string rang: of those that are sure of a spring the one that costs least, and less than
/// kPromising of the stiff `fit`; else nothing. (The stiff fit lies in another valley, which no slope at
/// `before` tells.)
template <class D>
std::optional<std::pair<Fit, ActiveSet>> with_spring_again(const Fit& fit, const Fit& before,
                                                           const ActiveSet& set, const Bank& bank,
                                                           const Model& physics, int threads,
                                                           const FitWatch& watch) {
  std::optional<std::pair<Fit, ActiveSet>> best;
  if (!is_dynamic(added_give(before.at)) || asked_spring(set)) return best;
  double least = kPromising * fit.cost;
  for (const Candidate* candidate : bank) {
    const ActiveSet free = with(set, *candidate);
    if (!asked_spring(free) || watch.is_enough()) continue;
    Fit trial = giving_alone(before, free).value_or(before);
    put_at_rest(trial, free);
    refine<D>(trial, physics, free, kMostIterations, threads, watch);
    const double cost = cost_with_noise_of(fit, trial, threads);
    const double z = significance(*candidate, estimates_of(Evidence(trial), free));
    if (!(cost < least) || !speaks_for(*candidate, z)) continue;
    least = cost;
    best.emplace(std::move(trial), free);
  }
  return best;
}

}  // namespace diabolo::diagnose_detail
