// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
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

/// A fit with a law that has no name.
struct UnnamedTrial {
  Leftover leftover;  ///< as the fit has it
  Model physics;      ///< the base of the fit
  Fit fit;
  ActiveSet set;
};

/// Fits the base with a leftover's law, its amplitude and its power, and with what is sure beside it; whether
/// it helps is what data says that is left out. (The power's first guess comes from all windows.)
template <class D>
UnnamedTrial try_unnamed(const Leftover& leftover, const Fit& fit, const Model& base, const Model& physics,
                         const ActiveSet& set, const Bank& bank, const std::vector<Recording>& holdout,
                         std::uint64_t seed, int threads, const Watch& watch) {
  UnnamedTrial trial{leftover, with_growth(physics, leftover.law), fit, set};
  PowerLaw& law = trial.leftover.law;
  const int u = index_of(leftover.unknown), power = index_of(Unknown::kPower);
  trial.fit.at[u] = law.value * std::pow(usual_of(law) / std::max(law.at, 1e-3), law.exponent);
  trial.set[u] = true;
  trial.set[power] = law.exponent != 0.0;
  refine<D>(trial.fit, trial.physics, trial.set, 6, threads, watch);
  trial.set = eliminate(Evidence(trial.fit), bank, trial.set);
  for (int i = 0; i < kUnknowns; ++i)
    if (!trial.set[i]) trial.fit.at[i] = trial.fit.centre[i];
  refine<D>(trial.fit, trial.physics, trial.set, 6, threads, watch);
  const Evidence evidence(trial.fit);
  ActiveSet without = trial.set;
  without[u] = without[power] = false;
  const HeldOut heldout = compare_held_out(leave_out(trial.fit, evidence, trial.set, {without}, holdout),
                                           base, trial.physics, seed, threads, watch);
  trial.leftover.worsening_ci95 = heldout.worsening_ci95.front();
  bool better = false, worse = false;
  for (const std::optional<Interval>& interval : trial.leftover.worsening_ci95) {
    better = better || (interval && interval->low > 0.0);
    worse = worse || (interval && interval->high < 0.0);
  }
  trial.leftover.in_model = better && !worse;
  const Standing now = standing(evidence, trial.set);
  trial.leftover.deviation = now.deviation(u);
  if (trial.set[power]) {
    law.exponent = std::clamp(law.exponent + trial.fit.at[power], -kLargestPower, kLargestPower);
    law.deviation = now.deviation(power);
  }
  law.value = trial.fit.at[u] * std::pow(law.at / usual_of(law), law.exponent);
  return trial;
}

}  // namespace diabolo
