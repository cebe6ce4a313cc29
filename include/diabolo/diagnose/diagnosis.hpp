// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/alternatives.hpp"
#include "diabolo/diagnose/axle_motion.hpp"
#include "diabolo/diagnose/conclude.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/diagnose/select.hpp"
#include "diabolo/diagnose/swapped_bodies.hpp"

namespace diabolo {

/// How a diagnosis is done.
struct DiagnosisOptions {
  Model base = consistent_model();  ///< the simulator that is asked about
  std::vector<Recording> holdout;   ///< to compare on; else recordings, or blocks, are left out in turn
  std::vector<std::string> bank;    ///< names of the candidates; empty: all
  double budget = 1e9;              ///< no new refit begins after it [s]
  std::uint64_t seed = 1;           ///< of the bootstrap
  int threads = 0;                  ///< 0: one for every processor; the result is the same
};

/// How a diagnosis is watched: the name of the step, and the fraction done of it all.
struct DiagnosisWatch {
  std::function<void(const std::string&, double)> progress;
  std::function<bool()> cancelled;
};

/// Fewest windows from which anything is concluded.
inline constexpr std::size_t kFewestWindows = 8;

/// A usual spin [rad/s].
inline constexpr double kUnseenSpin = 80.0;

/// The give of a soft string to begin with [m/N].
inline constexpr double kSoftStart = 3e-3;

namespace detail {

/// Why nothing can be concluded; empty where something can.
inline std::string insufficient(const std::vector<Stage>& stages) {
  std::size_t windows = 0, taut = 0;
  bool length_known = false, plausible = true;
  std::string lengths;
  for (const Stage& stage : stages) {
    windows += stage.windows.size();
    for (const FitWindow& window : stage.windows)
      taut += window.start.string_state == StringState::kOnString ? 1 : 0;
    if (const std::optional<double> usual = usual_path_length(stage.recording)) {
      length_known = true;
      const double given = stage.recording.string_length;
      if (std::abs(*usual - given) > info_of(Unknown::kStringLength).maximum) {
        plausible = false;
        lengths = shown(*usual) + " m where the string is " + shown(given) + " m long";
      }
    }
  }
  if (windows < kFewestWindows)
    return "only " + std::to_string(windows) + " windows of half a second can be compared; " +
           std::to_string(kFewestWindows) + " are needed";
  if (!plausible)
    return "the path from tip to tip over the diabolo is mostly " + lengths +
           ": wrong units, swapped bodies, or another string";
  if (!length_known || taut * 10 < windows) return "the string is never seen taut for long";
  return {};
}

inline Fit prepared(const std::vector<Recording>& recordings) {
  Fit fit;
  for (const Recording& recording : recordings) {
    fit.stages.push_back(make_stage(recording));
    fit.noise.emplace_back();
  }
  // A string's centre line lies half its thickness outside the axle: some 0.7 mm.
  fit.centre[index_of(Unknown::kAxleRadius)] = fit.stages.front().recording.properties.axle_radius + 7e-4;
  fit.centre[index_of(Unknown::kDamping)] = 10.0;
  fit.centre[index_of(Unknown::kTipMass)] = 0.011;  // of wooden and plastic sticks: 8 to 15 g
  fit.at = fit.centre;
  return fit;
}

/// From starts alone, with all of `set` free. A soft string rings, and from a stiff one the way there is long
/// and uphill where the one's rule ends and the other's begins: both are begun, and what leaves less is gone
/// on with.
template <class D>
void fit_everything(Fit& fit, const Model& physics, const ActiveSet& set, int threads, const Watch& watch) {
  fit.far_window = kFarWindowAtFirst;
  Fit soft = fit;
  refine<D>(fit, physics, set, 5, threads, watch);
  const Unknown give = set[index_of(Unknown::kCompliance)] ? Unknown::kCompliance : Unknown::kStickCompliance;
  if (set[index_of(give)]) {
    soft.at[index_of(give)] = kSoftStart;
    refine<D>(soft, physics, set, 5, threads, watch);
    if (left_over(soft) < 0.97 * left_over(fit)) fit = std::move(soft);
  }
  fit.far_window = kFarWindow;
  refine<D>(fit, physics, set, 6, threads, watch);
}

/// Leaves out what acts on the spin, or by it in a direction that nobody saw.
inline void without_spin(Bank& bank, ActiveSet& set) {
  for (const Unknown u :
       {Unknown::kLift, Unknown::kSpinAir, Unknown::kSpinAxle, Unknown::kSpinCoupling, Unknown::kSpinGain}) {
    set[index_of(u)] = false;
    std::erase_if(bank, [&](const Candidate* candidate) { return first_of(*candidate) == u; });
  }
}

/// Where nobody saw the diabolo turn: friction is begun with a fast spin of either sense, and what fits
/// better is gone on with. (It saturates with the slip: how fast does not matter.)
template <class D>
void fit_unseen_spin(Fit& fit, const Model& physics, const ActiveSet& set, int threads, const Watch& watch) {
  const auto begun = [&](double spin) {
    Fit trial = fit;
    for (Stage& stage : trial.stages)
      for (FitWindow& window : stage.windows) window.start.spin = spin;
    fit_everything<D>(trial, physics, set, threads, watch);
    return trial;
  };
  Fit forwards = begun(kUnseenSpin), backwards = begun(-kUnseenSpin);
  fit = std::move(left_over(forwards) <= left_over(backwards) ? forwards : backwards);
}

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
  Bank bank = bank_for(physics.parameters, options.bank);
  const auto step = [&](const std::string& name, double done) {
    if (watch.progress) watch.progress(name, done);
    return Watch{{}, watch.cancelled};
  };
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  Diagnosis result;
  result.base = options.base.name;
  result.base_gravity = physics.parameters.gravity;
  result.base_string_length = parameters_for(physics, recordings.front()).string_length;
  step("reading the motion", 0.0);
  Fit fit = detail::prepared(recordings);
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
  if (std::ranges::any_of(fit.stages, &Stage::has_spin)) {
    fit_everything<D>(fit, physics, set, options.threads, step("fitting everything", 0.15));
  } else {
    without_spin(bank, set);
    fit_unseen_spin<D>(fit, physics, set, options.threads, step("fitting everything", 0.15));
  }
  const Candidate& friction = candidate_of("string_friction");
  backwards = is_in(set, friction) && significance(friction, standing(Evidence(fit), set)) < -kSignificance;
  set = eliminate(Evidence(fit), bank, set);
  for (int round = 0;; ++round) {
    for (int u = 0; u < kUnknowns; ++u)
      if (!set[u]) fit.at[u] = fit.centre[u];
    refine<D>(fit, physics, set, 6, options.threads, step("refitting what is sure", 0.5 + 0.1 * round));
    const Evidence evidence(fit);
    ActiveSet next = eliminate(evidence, bank, set);
    if (const Candidate* candidate = strongest_left_out(evidence, bank, next)) next = with(next, *candidate);
    if ((next == set).all() || round == 2 || elapsed() > options.budget) break;  // judged at its own fit
    set = next;
  }
  Diagnosis draft = result;
  find(draft, fit, Evidence(fit), bank, set);
  const std::vector<Exchange> exchanged = exchange_claims<D>(fit, bank, set, draft, physics, options.threads,
                                                             step("trying other explanations", 0.8));
  const Evidence evidence(fit);
  result.at = fit.at;
  result.model = augmented_model(physics, fit.at, "diagnosed");
  if (std::ranges::find(bank, &candidate_of("frame_rate")) != bank.end())  // gravity is as it was
    result.model.parameters.gravity = physics.parameters.gravity;
  find(result, fit, evidence, bank, set);
  if (options.bank.empty() || std::ranges::count(options.bank, "gyroscopic_tilt") > 0)
    result.findings.push_back(find_axle_motion(fit, result.model));
  withdraw_what_cannot_be(result);
  for (const Exchange& exchange : exchanged)
    for (Finding& f : result.findings)
      if (f.claimed && f.candidate->name == exchange.name) f.tied_with = exchange.tied_with;
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
  result.heldout.whole_recordings = !options.holdout.empty() || recordings.size() > 1;
  withdraw_tips_that_do_not_help(result);
  if (withdraw_what_does_not_help(result)) result.model = options.base;
  if (numerical)
    result.numerical =
        compare_rules<D>(fit, options.base, physics, options.threads, step("comparing rules", 0.95));
  for (std::size_t s = 0; s < fit.stages.size(); ++s)
    result.noise.push_back({fit.stages[s].recording.name, fit.noise[s]});
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

/// Finds what a simulator leaves out. Throws RecordingError where a recording cannot be used at all,
/// std::invalid_argument about options, and Cancelled.
template <class D = detail::FitDual>
Diagnosis diagnose(std::vector<Recording> recordings, DiagnosisOptions options = {},
                   const DiagnosisWatch& watch = {}) {
  if (recordings.empty()) throw std::invalid_argument("recordings: none; at least one expected");
  check_threads(options.threads);
  long swapped = 0, frames = 0;
  for (Recording& recording : recordings) {
    swapped += static_cast<long>(unswap(recording).count);
    frames += static_cast<long>(recording.size());
  }
  for (Recording& recording : options.holdout) unswap(recording);
  bool backwards = false, still = false;
  Diagnosis result = detail::diagnose_named<D>(recordings, options, watch, backwards);
  if (backwards) {
    for (std::vector<Recording>* list : {&recordings, &options.holdout})
      for (Recording& recording : *list) recording = with_sticks_exchanged(std::move(recording));
    Diagnosis exchanged = detail::diagnose_named<D>(recordings, options, watch, still);
    const bool rubs = std::ranges::any_of(exchanged.findings, [](const Finding& f) {
      return f.claimed && f.candidate->name == "string_friction";
    });
    if (rubs && !still) {
      result = std::move(exchanged);
      swapped += frames;
    }
  }
  const bool asked = options.bank.empty() || std::ranges::count(options.bank, "body_swap") > 0;
  if (swapped > 0 && asked && result.reason.empty())
    detail::claim_swap(result, swapped,
                       swapped >= frames ? "friction would give energy unless the sticks are exchanged"
                                         : "bodies jump to each other's places and back");
  if (watch.progress) watch.progress("done", 1.0);
  return result;
}

}  // namespace diabolo
