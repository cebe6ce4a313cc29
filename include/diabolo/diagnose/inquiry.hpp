// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/alternatives.hpp"
#include "diabolo/diagnose/axle_motion.hpp"
#include "diabolo/diagnose/conclude.hpp"
#include "diabolo/diagnose/diagnosis_options.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/first_fit.hpp"
#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/diagnose/next_experiment.hpp"
#include "diabolo/diagnose/noise_trial.hpp"
#include "diabolo/diagnose/own_laws.hpp"
#include "diabolo/diagnose/refine.hpp"
#include "diabolo/diagnose/select.hpp"
#include "diabolo/diagnose/sufficient.hpp"
#include "diabolo/diagnose/thin.hpp"
#include "diabolo/diagnose/time_budget.hpp"
#include "diabolo/diagnose/unnamed_law.hpp"

namespace diabolo {

namespace diagnose_detail {

/// One diagnosis, with every body under its name.
template <class D>
class Inquiry {
 public:
  Inquiry(const std::vector<Recording>& recordings, const DiagnosisOptions& options,
          const DiagnosisWatch& watch, double seconds)
      : recordings_(recordings),
        options_(options),
        watch_(watch),
        budget_(seconds, watch.clock),
        numerical_(options.base.parameters.string_law != StringLaw::kInextensible),
        physics_(physics_without_rules(options.base)) {
    result_.own = own_candidates(physics_.effects.template get<FormulaLaws>(), options.laws);
    physics_.effects.template get<FormulaLaws>() = result_.own->laws;
    bank_ = bank_for(physics_.parameters, options.bank, result_.own->list);
    result_.base = options.base.name;
    result_.base_gravity = physics_.parameters.gravity;
    result_.base_string_length = parameters_for(physics_, recordings.front()).string_length;
  }

  Diagnosis answer() {
    read();
    if (result_.reason.empty()) fit_all();
    if (!result_.reason.empty()) {
      result_.model = options_.base;
    } else {
      settle();
      const bool withdrawn = look_for_unnamed(withdraw_what_does_not_help(result_));
      judge();
      if (withdrawn || withdraw_what_explains_too_little(result_)) result_.model = options_.base;
      result_.heldout.whole_recordings = !options_.holdout.empty() || recordings_.size() > 1;
      finish();
    }
    std::ranges::copy(budget_.left(), std::back_inserter(result_.not_done));
    conclude(result_);
    return std::move(result_);
  }

  /// Whether friction would have to give energy.
  bool backwards() const { return backwards_; }

 private:
  /// Tells of a step between two fractions of the work; it is watched until a share of the budget is spent.
  FitWatch step(const std::string& name, double begin, double end, double share = 1.0) const {
    const auto enough = [this, share] { return budget_.spent(share); };
    if (!watch_.progress) return {{{}, watch_.cancelled}, enough};
    watch_.progress(name, begin);
    return {
        {towards(begin, end, [this, name](double done) { watch_.progress(name, done); }), watch_.cancelled},
        enough};
  }

  void read() {
    step("reading the motion", 0.0, 0.03);
    fit_ = prepared(recordings_, physics_);
    result_.windows_seen = window_count(fit_.fit_takes);
    result_.reason = insufficient(fit_.fit_takes);
    if (!result_.reason.empty()) return;
    thin<D>(fit_, physics_, options_.threads, budget_, step("choosing what decides", 0.03, 0.05));
    refine<D>(fit_, physics_, ActiveSet::Constant(false), 2, options_.threads,
              step("fitting starts", 0.05, 0.15));
    remember_before(result_, fit_);
  }

  /// Fits everything, keeps what is sure and exchanges it for what explains more. Another delay than thought
  /// at first changes what all else looks like, as do springs so soft that it bounces: all is asked again.
  void fit_all() {
    set_ = asked_at_first(bank_);
    if (std::ranges::none_of(fit_.fit_takes, has_spin)) without_spin(bank_, set_);
    for (bool again = false;; again = true) {
      if (!fit_bank(again)) {
        result_.reason = "the budget of " + shown(options_.budget) +
                         " s is spent before anything fits; more time is needed";
        result_.windows.clear();
        return;
      }
      keep_what_is_sure(again);
      const Delay before = fit_.delay;
      exchange(again);
      const bool soft = !fit_.bounces && is_bouncy(fit_.at);
      if ((fit_.delay == before && !soft) ||
          !budget_.allows("asking all again with what was found", kFitsShare))
        return;
      ask_again(soft);
    }
  }

  /// Whether it was done in time; again, from what was found, it is no loss where it was not.
  bool fit_bank(bool again) {
    const FitWatch everything = step("fitting everything", again ? 0.6 : 0.15, again ? 0.7 : 0.4, kFitsShare);
    if (again)  // starts that bounce, or are late, are others
      approach<D>(fit_, physics_, ActiveSet::Constant(false), 3, options_.threads, everything);
    if (std::ranges::any_of(fit_.fit_takes, has_spin) || again)
      fit_everything<D>(fit_, physics_, set_, options_.threads, everything);
    else
      fit_unseen_spin<D>(fit_, physics_, set_, options_.threads, everything);
    return again || !everything.is_enough();
  }

  void keep_what_is_sure(bool again) {
    const Candidate& friction = candidate_of("string_friction");
    backwards_ =
        is_in(set_, friction) && significance(friction, estimates_of(Evidence(fit_), set_)) < -kSignificance;
    set_ = eliminate(Evidence(fit_), bank_, set_);
    for (int round = 0;; ++round) {
      const double begin = (again ? 0.7 : 0.4) + 0.03 * round;
      put_at_rest(fit_, set_);
      refine<D>(fit_, physics_, set_, kMostIterations, options_.threads,
                step("refitting what is sure", begin, begin + 0.03, kFitsShare));
      const Evidence evidence(fit_);
      ActiveSet next = eliminate(evidence, bank_, set_);
      if (const Candidate* candidate = strongest_left_out(evidence, bank_, next))
        next = with(next, *candidate);
      if ((next == set_).all() || round == 2 || !budget_.allows("asking again what is sure", kFitsShare))
        return;  // judged at its own fit
      set_ = next;
    }
  }

  void exchange(bool again) {
    Diagnosis draft = result_;
    find(draft, fit_, Evidence(fit_), bank_, set_);
    const FitWatch trying =
        step("trying other explanations", again ? 0.8 : 0.5, again ? 0.85 : 0.6, kFitsShare);
    std::ranges::move(exchange_claims<D>(fit_, bank_, set_, draft, physics_, options_.threads, trying),
                      std::back_inserter(exchanged_));
    if (trying.is_enough()) budget_.leave("trying all other explanations");
  }

  void ask_again(bool soft) {
    fit_.noise_is_known = false;
    fit_.bounces = fit_.bounces || soft;
    std::erase_if(exchanged_, [](const Replacement& e) {  // what is asked again
      return e.name != "string_wrap" && alternative_to(e.name) != "time_offset";
    });
    for (const Candidate* candidate : bank_)
      if (candidate->kind == CandidateKind::kPhysics && first_of(*candidate) != Unknown::kRestitution)
        set_ = with(set_, *candidate);
    if (std::ranges::none_of(fit_.fit_takes, has_spin)) without_spin(bank_, set_);
  }

  /// Claims what stands, and takes back, one after the other, what data that were left out deny.
  void settle() {
    for (;;) {
      claim();
      const Candidate* denied = compare();
      for (const Candidate* candidate : denied_) say_denied(result_, *candidate);
      if (denied == nullptr) return;
      denied_.push_back(denied);
      set_ = with(set_, *denied, false);
      put_at_rest(fit_, set_);
      refine<D>(fit_, physics_, set_, kMostIterations, options_.threads,
                step("refitting what is left", 0.85, 0.9, kTrialsShare));
    }
  }

  void claim() {
    const Evidence evidence(fit_);
    result_.at = fit_.at;
    result_.model = augmented_model(physics_, fit_.at, "diagnosed");
    if (std::ranges::find(bank_, &candidate_of("frame_rate")) != bank_.end())  // gravity is as it was
      result_.model.parameters.gravity = physics_.parameters.gravity;
    result_.findings.clear();
    result_.unexplained_forces.clear();
    find(result_, fit_, evidence, bank_, set_);
    if (!physics_.effects.template get<UnnamedForce>().neutral() || set_[index_of(Unknown::kPower)])
      result_.unexplained_forces.clear();  // they are told in units of the law that is there
    if (options_.bank.empty() || std::ranges::count(options_.bank, "gyroscopic_tilt") > 0)
      result_.findings.push_back(find_axle_motion(fit_, result_.model));
    withdraw_what_cannot_be(result_);
    Bank possible = bank_;
    for (const Candidate* candidate : denied_) std::erase(possible, candidate);
    withdraw_what_may_be_physics(result_, evidence, possible, set_);
    for (Finding& f : result_.findings) {
      for (const Replacement& exchange : exchanged_)
        if (f.claimed && f.candidate->name == exchange.name) f.tied_with = exchange.tied_with;
      for (const Candidate* candidate : denied_) std::erase(f.tied_with, candidate->name);
    }
    for (const Replacement& exchange : exchanged_)
      if (exchange.name == "string_wrap") claim_wraps(result_, fit_, exchange.z);
  }

  /// Compares on data left out, with all claims and without each; returns what these deny.
  const Candidate* compare() {
    std::vector<ActiveSet> without;
    for (const Finding& f : result_.findings)
      if (f.claimed) without.push_back(with(set_, *f.candidate, false));
    const std::vector<HeldOutRecording> held =
        leave_out(fit_, Evidence(fit_), set_, without, options_.holdout);
    result_.heldout = compare_held_out(held, options_.base, physics_, options_.seed, fit_.most_windows,
                                       options_.threads, step("comparing on data left out", 0.85, 0.9));
    for (std::size_t i = 0; i < without.size(); ++i)  // claims come first
      result_.findings[i].worsening_ci95 = result_.heldout.worsening_ci95[i];
    return withdraw_what_left_out_data_deny(result_);
  }

  /// Takes a law without a name into the model where it helps. Returns whether what was found is withdrawn.
  bool look_for_unnamed(bool withdrawn) {
    if (!physics_.effects.template get<UnnamedForce>().neutral()) {
      result_.not_done.push_back("looking for forces without a name beside the base's own");
      return withdrawn;
    }
    if (withdrawn || !budget_.allows("looking for forces without a name", kTrialsShare)) return withdrawn;
    const FitWatch looking = step("fitting what has no name", 0.9, 0.95, kTrialsShare);
    for (UnexplainedForce& leftover :
         laws_to_try<D>(result_.unexplained_forces, fit_, physics_, set_, options_.threads, looking)) {
      UnnamedTrial trial = try_unnamed<D>(leftover, fit_, options_.base, physics_, set_, bank_,
                                          options_.holdout, options_.seed, options_.threads, looking);
      if (trial.worsening_ci95.empty()) {
        budget_.leave("fitting a force without a name");
        break;
      }
      leftover.worsening_ci95 = trial.worsening_ci95;
      if (!result_.unexplained_forces.empty())
        result_.unexplained_forces.front().worsening_ci95 = trial.worsening_ci95;
      if (!trial.helps) continue;
      physics_ = std::move(trial.physics);
      fit_ = std::move(trial.fit);
      set_ = trial.set;
      result_.heldout.ahead = std::move(trial.ahead);
      settle();
      withdrawn = withdraw_what_does_not_help(result_);
      result_.unexplained_forces.insert(result_.unexplained_forces.begin(),
                                        as_fitted(leftover, leftover.law.exponent, fit_, set_));
      result_.unexplained_forces.front().in_model = !withdrawn;
      break;
    }
    return withdrawn;
  }

  /// Compares what is left with what noise alone would leave.
  void judge() {
    const char* const asking = "asking what noise alone would leave";
    if (!budget_.allows(asking, kRulesShare)) return;
    result_.adequacy = adequacy_of<D>(result_.windows, fit_, physics_, result_.heldout.ahead, options_.seed,
                                      options_.threads, step(asking, 0.95, 0.96, kRulesShare));
  }

  /// The numerical rules' share, the noise, and what to record next.
  void finish() {
    if (numerical_ && budget_.allows("comparing rules", kRulesShare)) {
      Model rules = options_.base;
      rules.effects.template get<UnnamedForce>() = physics_.effects.template get<UnnamedForce>();
      result_.numerical =
          compare_rules<D>(fit_, rules, physics_, options_.threads, step("comparing rules", 0.96, 0.97));
    }
    for (std::size_t s = 0; s < fit_.fit_takes.size(); ++s)
      result_.noise.push_back({fit_.fit_takes[s].take->recording.name, fit_.noise[s]});
    const char* const proposing = "proposing what to record next";
    if (!budget_.allows(proposing, 1.0)) return;
    const FitWatch looking = step(proposing, 0.97, 1.0);
    result_.proposals = next_experiments<D>(result_, fit_, physics_, set_, options_.threads, looking);
    if (looking.is_enough()) budget_.leave(proposing);
  }

  const std::vector<Recording>& recordings_;
  const DiagnosisOptions& options_;
  const DiagnosisWatch& watch_;
  TimeBudget budget_;
  bool numerical_;
  Model physics_;
  Bank bank_;
  Fit fit_;
  ActiveSet set_ = ActiveSet::Constant(false);
  std::vector<Replacement> exchanged_;
  std::vector<const Candidate*> denied_;
  bool backwards_ = false;
  Diagnosis result_;
};

}  // namespace diagnose_detail
}  // namespace diabolo
