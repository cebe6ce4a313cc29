// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/heldout.hpp"

namespace diabolo {

/// `base` with the power by which a law grows, its amplitude zero. (A power of zero is none.)
inline Model with_growth(Model base, const PowerLaw& law) {
  auto& force = base.effects.get<UnnamedForce>();
  force = {};
  (law.scalar == "spin" ? force.spin_exponent : force.speed_exponent) = law.exponent;
  return base;
}

/// x / at to this power is what UnnamedForce multiplies with.
inline double usual_of(const PowerLaw& law) {
  return law.scalar == "spin" ? UnnamedForce<double>::kSpin : 1.0;
}

/// A leftover's law as a fit has it, whose base grows by `first`, the power that was begun with.
inline Leftover as_fitted(Leftover leftover, double first, const Fit& fit, const ActiveSet& set) {
  PowerLaw& law = leftover.law;
  const int u = index_of(leftover.unknown), power = index_of(Unknown::kPower);
  const Standing now = standing(Evidence(fit), set);
  if (set[power]) {
    law.exponent = std::clamp(first + fit.at[power], -kLargestPower, kLargestPower);
    law.deviation = now.deviation(power);
  }
  const double there = std::pow(std::max(law.at, 1e-3) / usual_of(law), law.exponent);
  leftover.value = law.value = fit.at[u] * there;
  leftover.deviation = now.deviation(u) * there;
  leftover.z = leftover.deviation > 0.0 ? leftover.value / leftover.deviation : 0.0;
  const Candidate latent{"", "", CandidateKind::kPhysics, {leftover.unknown}, 0.0, false};
  leftover.size = size_of(latent, fit.at, fit.systems);
  return leftover;
}

/// A fit with a law that has no name.
struct UnnamedTrial {
  Model physics;  ///< the base of the fit
  Fit fit;
  ActiveSet set;
  std::vector<std::optional<Interval>> worsening_ci95;  ///< see Leftover
  bool helps = false;
};

/// Fits the base with a leftover's law, its amplitude and its power, and with what is sure beside it; whether
/// it helps is what data says that is left out. (The power's first guess comes from all windows.)
template <class D>
UnnamedTrial try_unnamed(const Leftover& leftover, const Fit& fit, const Model& base, const Model& physics,
                         const ActiveSet& set, const Bank& bank, const std::vector<Recording>& holdout,
                         std::uint64_t seed, int threads, const Watch& watch) {
  const PowerLaw& law = leftover.law;
  UnnamedTrial trial{with_growth(physics, law), fit, set, {}};
  const int u = index_of(leftover.unknown), power = index_of(Unknown::kPower);
  trial.fit.at[u] = std::clamp(law.value * std::pow(usual_of(law) / std::max(law.at, 1e-3), law.exponent),
                               info_of(leftover.unknown).minimum, info_of(leftover.unknown).maximum);
  trial.set[u] = true;
  trial.set[power] = law.exponent != 0.0;
  refine<D>(trial.fit, trial.physics, trial.set, 6, threads, watch);
  trial.set = eliminate(Evidence(trial.fit), bank, trial.set);
  for (int i = 0; i < kUnknowns; ++i)
    if (!trial.set[i]) trial.fit.at[i] = trial.fit.centre[i];
  refine<D>(trial.fit, trial.physics, trial.set, 6, threads, watch);
  ActiveSet without = trial.set;
  without[u] = without[power] = false;
  const HeldOut heldout =
      compare_held_out(leave_out(trial.fit, Evidence(trial.fit), trial.set, {without}, holdout), base,
                       trial.physics, seed, threads, watch);
  trial.worsening_ci95 = heldout.worsening_ci95.front();
  bool better = false, worse = false;
  for (const std::optional<Interval>& interval : trial.worsening_ci95) {
    better = better || (interval && interval->low > 0.0);
    worse = worse || (interval && interval->high < 0.0);
  }
  trial.helps = better && !worse;
  return trial;
}

}  // namespace diabolo
