// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/diagnose/refine.hpp"
#include "diabolo/effects/unnamed_force.hpp"

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

/// The strongest force without a name that grows with speed or spin, or with its square, whether or not a
/// constant one stands out; nothing where none does.
template <class D>
std::optional<UnexplainedForce> growing_leftover(const Fit& fit, const Model& physics, const ActiveSet& set,
                                                 int threads, const FitWatch& watch) {
  std::optional<UnexplainedForce> strongest;
  ActiveSet asked = set;
  asked.segment<kLatentForces>(kLatentFirst).setConstant(true);
  for (const std::string_view scalar : {"speed", "spin"})
    for (const double exponent : {1.0, 2.0}) {
      PowerLaw law;
      law.scalar = scalar;
      law.unit = scalar == "spin" ? "rad/s" : "m/s";
      law.exponent = exponent;
      law.at = usual_of(law);
      Fit grown = fit;
      linearize<D>(grown, with_growth(physics, law), asked, threads, watch);
      const Evidence evidence(grown);
      for (int u = kLatentFirst; u < kLatentFirst + kLatentForces; ++u) {
        if (set[u]) continue;
        ActiveSet with_force = set;
        with_force[u] = true;
        const Estimates own = estimates_of(evidence, with_force);
        const double deviation = own.deviation(u), z = deviation > 0.0 ? own.estimate[u] / deviation : 0.0;
        const Candidate latent{"", "", CandidateKind::kPhysics, {static_cast<Unknown>(u)}, 0.0, false};
        const double size = size_of(latent, own.estimate, grown.systems);
        if (!stands_out(z, size) || (strongest && std::abs(z) <= std::abs(strongest->z))) continue;
        law.value = own.estimate[u];
        strongest = UnexplainedForce{static_cast<Unknown>(u), law.value, deviation, z, size, law};
      }
    }
  return strongest;
}

/// What a fit may be tried with: the strongest that grows, and the strongest of `unexplained_forces`, which
/// comes first.
template <class D>
std::vector<UnexplainedForce> laws_to_try(std::vector<UnexplainedForce>& unexplained_forces, const Fit& fit,
                                          const Model& physics, const ActiveSet& set, int threads,
                                          const FitWatch& watch) {
  std::ranges::stable_sort(unexplained_forces, std::greater<>(),
                           [](const UnexplainedForce& l) { return std::abs(l.z); });
  std::vector<UnexplainedForce> result;
  if (const auto growing = growing_leftover<D>(fit, physics, set, threads, watch)) result.push_back(*growing);
  if (!unexplained_forces.empty()) result.push_back(unexplained_forces.front());
  return result;
}

/// A leftover's law as a fit has it, whose base grows by `first`, the power that was begun with.
inline UnexplainedForce as_fitted(UnexplainedForce leftover, double first, const Fit& fit,
                                  const ActiveSet& set) {
  PowerLaw& law = leftover.law;
  const int u = index_of(leftover.unknown), power = index_of(Unknown::kPower);
  const Estimates now = estimates_of(Evidence(fit), set);
  if (set[power]) {
    law.exponent = std::clamp(first + fit.at[power], -UnnamedForce<double>::kLargestPower,
                              UnnamedForce<double>::kLargestPower);
    law.deviation = now.deviation(power);
  }
  const std::vector<WindowSays> windows = windows_by(law.scalar, fit, leftover.unknown);
  if (!windows.empty()) law.at = windows[windows.size() / 2].x;
  const auto grown = [&](double x) { return fit.at[u] * std::pow(x / usual_of(law), law.exponent); };
  law.curve.clear();
  for (std::size_t k = 0; k <= 5 && !windows.empty(); ++k) {
    const double x = windows[(windows.size() - 1) * k / 5].x;
    law.curve.emplace_back(x, grown(x));
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
  std::vector<std::optional<Interval>> worsening_ci95;  ///< see UnexplainedForce
  std::vector<LeftOver> ahead = {};                     ///< see HeldOut
  bool helps = false;
};

/// Fits the base with a leftover's law, its amplitude and its power, and with what is sure beside it; whether
/// it helps is what data says that is left out. (The power's first guess comes from all windows.)
template <class D>
UnnamedTrial try_unnamed(const UnexplainedForce& leftover, const Fit& fit, const Model& base,
                         const Model& physics, const ActiveSet& set, const Bank& bank,
                         const std::vector<Recording>& holdout, std::uint64_t seed, int threads,
                         const FitWatch& watch) {
  const PowerLaw& law = leftover.law;
  UnnamedTrial trial{with_growth(physics, law), fit, set, {}};
  const int u = index_of(leftover.unknown), power = index_of(Unknown::kPower);
  trial.fit.at[u] = std::clamp(law.value * std::pow(usual_of(law) / std::max(law.at, 1e-3), law.exponent),
                               info_of(leftover.unknown).minimum, info_of(leftover.unknown).maximum);
  trial.set[u] = true;
  trial.set[power] = law.exponent != 0.0;
  approach<D>(trial.fit, trial.physics, trial.set, 6, threads, watch);
  trial.set = eliminate(Evidence(trial.fit), bank, trial.set);
  for (int i = 0; i < kUnknowns; ++i)
    if (!trial.set[i]) trial.fit.at[i] = trial.fit.centre[i];
  refine<D>(trial.fit, trial.physics, trial.set, 6, threads, watch);
  if (watch.is_enough()) return trial;  // it may not have settled
  ActiveSet without = trial.set;
  without[u] = without[power] = false;
  const HeldOut heldout =
      compare_held_out(leave_out(trial.fit, Evidence(trial.fit), trial.set, {without}, holdout), base,
                       trial.physics, seed, trial.fit.most_windows, threads, watch);
  trial.worsening_ci95 = heldout.worsening_ci95.front();
  trial.ahead = heldout.ahead;
  bool better = false, worse = false;
  for (const std::optional<Interval>& interval : trial.worsening_ci95) {
    better = better || (interval && interval->low > 0.0);
    worse = worse || (interval && interval->high < 0.0);
  }
  const double exponent = law.exponent + trial.fit.at[power];
  trial.helps = better && !worse && std::abs(exponent) <= UnnamedForce<double>::kLargestPower;
  return trial;
}

}  // namespace diabolo
