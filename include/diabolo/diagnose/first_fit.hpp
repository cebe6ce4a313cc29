// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/first_spring.hpp"
#include "diabolo/diagnose/refine.hpp"

namespace diabolo {

/// A usual spin [rad/s].
inline constexpr double kUnseenSpin = 80.0;

/// The give of a soft string to begin with [m/N].
inline constexpr double kSoftStart = 3e-3;

namespace diagnose_detail {

/// What a diagnosis begins with. The published rules are numerical: physics is looked for on the string that
/// obeys its constraint. A force without a name is constant at first, as what is looked for.
inline Model physics_without_rules(const Model& base) {
  Model physics = base;
  if (base.parameters.string_law != StringLaw::kInextensible) {
    physics = consistent_model();
    physics.effects = base.effects;
  }
  auto& unnamed = physics.effects.get<UnnamedForce>();
  if (unnamed.neutral()) unnamed = {};
  return physics;
}

/// Recordings made ready, and what is expected of the unknowns.
inline Fit prepared(const std::vector<Recording>& recordings, const Model& physics) {
  Fit fit;
  for (const Recording& recording : recordings) {
    fit.fit_takes.push_back(make_fit_take(recording));
    fit.noise.emplace_back();
  }
  // A string's centre line lies half its thickness outside the axle: some 0.7 mm.
  const double known = physics.effects.get<FiniteAxle>().radius;
  fit.centre[index_of(Unknown::kAxleRadius)] =
      known > 0.0 ? known : parameters_for(physics, recordings.front()).axle_radius + 7e-4;
  // Beside a spring that is looked for; one that the base has brings its own.
  if (physics.effects.get<StringElasticity>().neutral()) fit.centre[index_of(Unknown::kDamping)] = 10.0;
  if (physics.effects.get<StickFlex>().neutral())
    fit.centre[index_of(Unknown::kTipMass)] = 0.011;  // of wooden and plastic sticks: 8 to 15 g
  fit.at = fit.centre;
  return fit;
}

/// A first approach from a soft string, where what gives is free. From a stiff one the way there is long and
/// uphill.
template <class D>
std::optional<Fit> softly_begun(Fit fit, const ActiveSet& set, const Model& physics, int threads,
                                const FitWatch& watch) {
  const std::optional<AskedSpring> asked = asked_spring(set);
  if (!asked) return std::nullopt;
  fit.at[asked->give] = kSoftStart;
  approach<D>(fit, physics, set, kMostIterations, threads, watch);
  return fit;
}

/// From starts alone, with all of `set` free, stiff and soft: the cheaper fit is kept. Where both end on an
/// oscillating string, rough costs say little: the other one converges, too, and is kept where it then costs
/// clearly less. Where the kept one is stiff and another spring promises much, that is fitted, too. At the
/// end the fit has been looked at with `set`. Returns whether there was time for the first one.
template <class D>
bool fit_everything(Fit& fit, const Model& physics, const ActiveSet& set, int threads,
                    const FitWatch& watch) {
  const auto settle = [&](Fit& rough) {
    rough.far_window = kFarWindow;
    reweight(rough, threads);
    descend<D>(rough, physics, set, kMostIterations, threads, watch);
  };
  const auto rings = [&](const Fit& rough) {
    return is_dynamic(give_of(physics.effects) + added_give(rough.at));
  };
  const auto exchange_if_cheaper = [&](Fit&& other, double share = 1.0) {
    if (cost_with_noise_of(fit, other, threads) < share * fit.cost) fit = std::move(other);
  };
  fit.far_window = kFarWindowAtFirst;
  const Fit begun = fit;
  approach<D>(fit, physics, set, kMostIterations, threads, watch);
  std::optional<Fit> soft = softly_begun<D>(begun, set, physics, threads, watch), ringing;
  if (soft && cost_with_noise_of(fit, *soft, threads) < fit.cost) std::swap(fit, *soft);
  const bool both_ring = soft && rings(fit) && rings(*soft);
  if (!rings(fit)) ringing = another_spring<D>(fit, set, physics, threads, watch);
  settle(fit);
  if (watch.is_enough()) return false;
  if (both_ring) {
    settle(*soft);
    exchange_if_cheaper(*std::move(soft), kPromising);
  }
  if (ringing) {
    approach<D>(*ringing, physics, set, kMostIterations, threads, watch);
    settle(*ringing);
    exchange_if_cheaper(*std::move(ringing));
  }
  return true;
}

/// What is free in the first fit. A bounce throws every later catch about: it is asked about once the rest
/// fits.
inline ActiveSet asked_at_first(const Bank& bank) {
  ActiveSet set = nuisances();
  for (const Candidate* candidate : bank) set = with(set, *candidate);
  set[index_of(Unknown::kRestitution)] = false;
  if (set[index_of(Unknown::kGravity)]) set[index_of(Unknown::kLengthScale)] = false;  // see bank_for()
  return set;
}

/// Leaves out what acts on the spin, or by it in a direction that nobody saw.
inline void without_spin(Bank& bank, ActiveSet& set) {
  for (const Candidate& candidate : candidates())
    if (candidate.by_spin) set = with(set, candidate, false);
  for (const Candidate* candidate : bank)  // somebody's own among them
    if (candidate->by_spin) set = with(set, *candidate, false);
  std::erase_if(bank, [](const Candidate* candidate) { return candidate->by_spin; });
}

/// Where nobody saw the diabolo turn, in some takes or in all: friction is begun there with a fast spin of
/// either sense, and what fits better is gone on with. (It saturates with the slip: how fast does not
/// matter.)
template <class D>
bool fit_unseen_spin(Fit& fit, const Model& physics, const ActiveSet& set, int threads,
                     const FitWatch& watch) {
  bool in_time = true;
  const auto begun = [&](double spin) {
    Fit trial = fit;
    for (FitTake& fit_take : trial.fit_takes)
      for (FitWindow& window : fit_take.windows)
        if (!has_spin(fit_take)) window.start.spin = spin;
    in_time = fit_everything<D>(trial, physics, set, threads, watch) && in_time;
    return trial;
  };
  Fit forwards = begun(kUnseenSpin), backwards = begun(-kUnseenSpin);
  fit = std::move(left_over(forwards) <= left_over(backwards) ? forwards : backwards);
  return in_time;
}

}  // namespace diagnose_detail

}  // namespace diabolo
