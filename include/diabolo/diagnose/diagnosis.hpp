// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/alternatives.hpp"
#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/axle_motion.hpp"
#include "diabolo/diagnose/conclude.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/first_fit.hpp"
#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/diagnose/next_experiment.hpp"
#include "diabolo/diagnose/refine.hpp"
#include "diabolo/diagnose/select.hpp"
#include "diabolo/diagnose/sufficient.hpp"
#include "diabolo/diagnose/unnamed_law.hpp"
#include "diabolo/recording/plausibility/odd_tracking.hpp"
#include "diabolo/recording/plausibility/swapped_bodies.hpp"

namespace diabolo {

namespace detail {

/// With every body under its name, unless friction would have to give energy: then `backwards`.
template <class D>
Diagnosis diagnose_named(const std::vector<Recording>& recordings, const DiagnosisOptions& options,
                         const DiagnosisWatch& watch, bool& backwards) {
  // The published rules are numerical: physics is looked for on the string that obeys its constraint.
  const bool numerical = options.base.parameters.string_law != StringLaw::kInextensible;
  Model physics = options.base;
  if (numerical) {
    physics = consistent_model();
    physics.effects = options.base.effects;
  }
  auto& unnamed = physics.effects.get<UnnamedForce>();
  if (unnamed.neutral()) unnamed = {};  // constant, as what is looked for
  Bank bank = bank_for(physics.parameters, options.bank);
  const auto step = [&](const std::string& name, double done) {
    if (watch.progress) watch.progress(name, done);
    return Watch{{}, watch.cancelled};
  };
  const auto begin = std::chrono::steady_clock::now();
  Diagnosis result;
  // What there is no time for is told.
  const auto may_still_do = [&](const char* what) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    const bool left = elapsed.count() < options.budget;
    if (!left) result.not_done.push_back(std::string(what) + " (no time left)");
    return left;
  };
  result.base = options.base.name;
  result.base_gravity = physics.parameters.gravity;
  result.base_string_length = parameters_for(physics, recordings.front()).string_length;
  step("reading the motion", 0.0);
  Fit fit = detail::prepared(recordings, physics);
  result.reason = detail::insufficient(fit.stages);
  if (!result.reason.empty()) {
    result.model = options.base;
    conclude(result);
    return result;
  }
  refine<D>(fit, physics, ActiveSet::Constant(false), 2, options.threads, step("fitting starts", 0.05));
  remember_before(result, fit);
  ActiveSet set = nuisances();
  for (const Candidate* candidate : bank) set = with(set, *candidate);
  // A bounce throws every later catch about: it is asked about once the rest fits.
  set[index_of(Unknown::kRestitution)] = false;
  if (set[index_of(Unknown::kGravity)]) set[index_of(Unknown::kLengthScale)] = false;  // see bank_for()
  if (std::ranges::none_of(fit.stages, &Stage::has_spin)) without_spin(bank, set);
  // Another delay than was thought at first changes what all else looks like, and so do springs so soft that
  // the diabolo's bounce on them is seen: then everything is asked again.
  std::vector<Exchange> exchanged;
  for (bool again = false;; again = true) {
    const Watch everything = step("fitting everything", again ? 0.6 : 0.15);
    if (again)  // starts that bounce, or are late, are others
      approach<D>(fit, physics, ActiveSet::Constant(false), 3, options.threads, everything);
    if (std::ranges::any_of(fit.stages, &Stage::has_spin) || again)
      fit_everything<D>(fit, physics, set, options.threads, everything);
    else
      fit_unseen_spin<D>(fit, physics, set, options.threads, everything);
    const Candidate& friction = candidate_of("string_friction");
    backwards = is_in(set, friction) && significance(friction, standing(Evidence(fit), set)) < -kSignificance;
    set = eliminate(Evidence(fit), bank, set);
    for (int round = 0;; ++round) {
      for (int u = 0; u < kUnknowns; ++u)
        if (!set[u]) fit.at[u] = fit.centre[u];
      refine<D>(fit, physics, set, kMostIterations, options.threads,
                step("refitting what is sure", (again ? 0.7 : 0.4) + 0.03 * round));
      const Evidence evidence(fit);
      ActiveSet next = eliminate(evidence, bank, set);
      if (const Candidate* candidate = strongest_left_out(evidence, bank, next))
        next = with(next, *candidate);
      if ((next == set).all() || round == 2 || !may_still_do("asking again what is sure"))
        break;  // judged at its own fit
      set = next;
    }
    Diagnosis draft = result;
    find(draft, fit, Evidence(fit), bank, set);
    const Delay before = fit.delay;
    std::ranges::move(exchange_claims<D>(fit, bank, set, draft, physics, options.threads,
                                         step("trying other explanations", again ? 0.8 : 0.5)),
                      std::back_inserter(exchanged));
    const bool soft = !fit.bounces && detail::is_bouncy(fit.at);
    if ((fit.delay == before && !soft) || !may_still_do("asking all again with what was found")) break;
    fit.noise_is_known = false;
    fit.bounces = fit.bounces || soft;
    std::erase_if(exchanged, [](const Exchange& e) {  // what is asked again
      return e.name != "string_wrap" && alternative_to(e.name) != "time_offset";
    });
    for (const Candidate* candidate : bank)
      if (candidate->kind == CandidateKind::kPhysics && first_of(*candidate) != Unknown::kRestitution)
        set = with(set, *candidate);
    if (std::ranges::none_of(fit.stages, &Stage::has_spin)) without_spin(bank, set);
  }
  std::vector<const Candidate*> denied;
  const auto settle = [&] {
    for (;;) {
      const Evidence evidence(fit);
      result.at = fit.at;
      result.model = augmented_model(physics, fit.at, "diagnosed");
      if (std::ranges::find(bank, &candidate_of("frame_rate")) != bank.end())  // gravity is as it was
        result.model.parameters.gravity = physics.parameters.gravity;
      result.findings.clear();
      result.leftovers.clear();
      find(result, fit, evidence, bank, set);
      if (!physics.effects.get<UnnamedForce>().neutral() || set[index_of(Unknown::kPower)])
        result.leftovers.clear();  // they are told in units of the law that is there
      if (options.bank.empty() || std::ranges::count(options.bank, "gyroscopic_tilt") > 0)
        result.findings.push_back(find_axle_motion(fit, result.model));
      withdraw_what_cannot_be(result);
      Bank possible = bank;
      for (const Candidate* candidate : denied) std::erase(possible, candidate);
      withdraw_what_may_be_physics(result, evidence, possible, set);
      for (const Exchange& exchange : exchanged)
        for (Finding& f : result.findings)
          if (f.claimed && f.candidate->name == exchange.name) f.tied_with = exchange.tied_with;
      for (const Candidate* candidate : denied)
        for (Finding& f : result.findings) std::erase(f.tied_with, candidate->name);
      for (const Exchange& exchange : exchanged)
        if (exchange.name == "string_wrap") claim_wraps(result, fit, exchange.z);
      std::vector<ActiveSet> without;
      for (const Finding& f : result.findings)
        if (f.claimed) without.push_back(with(set, *f.candidate, false));
      const std::vector<HeldOutRecording> held = leave_out(fit, evidence, set, without, options.holdout);
      result.heldout = compare_held_out(held, options.base, physics, options.seed, options.threads,
                                        step("comparing on data left out", 0.85));
      for (std::size_t i = 0; i < without.size(); ++i)  // claims come first
        result.findings[i].worsening_ci95 = result.heldout.worsening_ci95[i];
      const Candidate* physics_denied = withdraw_what_left_out_data_deny(result);
      for (const Candidate* candidate : denied) say_denied(result, *candidate);
      if (physics_denied == nullptr) return;
      denied.push_back(physics_denied);
      set = with(set, *physics_denied, false);
      for (int u = 0; u < kUnknowns; ++u)
        if (!set[u]) fit.at[u] = fit.centre[u];
      refine<D>(fit, physics, set, kMostIterations, options.threads, step("refitting what is left", 0.85));
    }
  };
  settle();
  bool withdrawn = withdraw_what_does_not_help(result);
  if (!physics.effects.get<UnnamedForce>().neutral()) {
    result.not_done.push_back("looking for forces without a name beside the base's own");
  } else if (!withdrawn && may_still_do("looking for forces without a name")) {
    const Watch looking = step("fitting what has no name", 0.9);
    for (Leftover& leftover : laws_to_try<D>(result.leftovers, fit, physics, set, options.threads, looking)) {
      UnnamedTrial trial = try_unnamed<D>(leftover, fit, options.base, physics, set, bank, options.holdout,
                                          options.seed, options.threads, looking);
      leftover.worsening_ci95 = trial.worsening_ci95;
      if (!result.leftovers.empty()) result.leftovers.front().worsening_ci95 = trial.worsening_ci95;
      if (!trial.helps) continue;
      physics = std::move(trial.physics);
      fit = std::move(trial.fit);
      set = trial.set;
      settle();
      withdrawn = withdraw_what_does_not_help(result);
      result.leftovers.insert(result.leftovers.begin(), as_fitted(leftover, leftover.law.exponent, fit, set));
      result.leftovers.front().in_model = !withdrawn;
      break;
    }
  }
  if (withdrawn) result.model = options.base;
  result.heldout.whole_recordings = !options.holdout.empty() || recordings.size() > 1;
  if (numerical) {
    Model rules = options.base;
    rules.effects.get<UnnamedForce>() = physics.effects.get<UnnamedForce>();
    result.numerical = compare_rules<D>(fit, rules, physics, options.threads, step("comparing rules", 0.95));
  }
  for (std::size_t s = 0; s < fit.stages.size(); ++s)
    result.noise.push_back({fit.stages[s].recording.name, fit.noise[s]});
  if (may_still_do("proposing what to record next"))
    result.proposals = next_experiments<D>(result, fit, physics, set, options.threads,
                                           step("looking for what to record next", 0.97));
  conclude(result);
  return result;
}

/// Claims that bodies were recorded under each other's names in so many frames.
inline void claim_swap(Diagnosis& d, long frames, const std::string& reason) {
  Finding f;
  f.candidate = &candidate_of("body_swap");
  f.p_value = 0.0;
  f.claimed = f.material = true;
  f.confidence = 0.99;
  f.swapped = frames;
  f.reason = reason;
  d.findings.insert(d.findings.begin(), f);
  conclude(d);
}

}  // namespace detail

template <class D>
Diagnosis diagnose(std::vector<Recording> recordings, DiagnosisOptions options, const DiagnosisWatch& watch) {
  if (recordings.empty()) throw std::invalid_argument("recordings: none; at least one expected");
  check_threads(options.threads);
  long swapped = 0, frames = 0;
  std::string places;
  bool sides_are_right = true, sides_are_wrong = false;
  for (std::vector<Recording>* list : {&recordings, &options.holdout})
    for (Recording& recording : *list) {
      const Swaps swaps = unswap(recording);
      const long jumped = static_cast<long>(swaps.count), rows = static_cast<long>(recording.size());
      const std::optional<bool> exchanged = sticks_are_exchanged(recording);
      if (exchanged.value_or(false)) recording = with_sticks_exchanged(std::move(recording));
      if (list != &recordings) continue;
      sides_are_right = sides_are_right && !exchanged.value_or(true);
      sides_are_wrong = sides_are_wrong || exchanged.value_or(false);
      swapped += exchanged.value_or(false) ? rows - jumped : jumped;
      frames += rows;
      if (swaps.count > 0) places += "; in " + recording.name + " from " + times_of(swaps, recording.time);
    }
  bool backwards = false, still = false, by_friction = false;
  Diagnosis result = detail::diagnose_named<D>(recordings, options, watch, backwards);
  if (backwards && !sides_are_right) {
    for (std::vector<Recording>* list : {&recordings, &options.holdout})
      for (Recording& recording : *list) recording = with_sticks_exchanged(std::move(recording));
    Diagnosis exchanged = detail::diagnose_named<D>(recordings, options, watch, still);
    const bool rubs = std::ranges::any_of(exchanged.findings, [](const Finding& f) {
      return f.claimed && f.candidate->name == "string_friction";
    });
    if (rubs && !still) {
      result = std::move(exchanged);
      by_friction = true;
    }
  }
  if (by_friction) swapped = frames - swapped;
  const std::string reason = by_friction       ? "friction would give energy unless the sticks are exchanged"
                             : sides_are_wrong ? "seen along the sticks, the left one is on the right"
                                               : "bodies jump to each other's places and back" + places;
  const bool asked = options.bank.empty() || std::ranges::count(options.bank, "body_swap") > 0;
  if (swapped > 0 && asked && result.reason.empty()) detail::claim_swap(result, swapped, reason);
  if (watch.progress) watch.progress("done", 1.0);
  return result;
}

}  // namespace diabolo
