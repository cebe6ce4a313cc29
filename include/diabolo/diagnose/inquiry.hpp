// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/ask_wraps_again.hpp"
#include "diabolo/diagnose/axle_laws.hpp"
#include "diabolo/diagnose/claim_search.hpp"
#include "diabolo/diagnose/claim_wraps.hpp"
#include "diabolo/diagnose/conclude.hpp"
#include "diabolo/diagnose/differing.hpp"
#include "diabolo/diagnose/final_fit.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/diagnose/learn_law.hpp"
#include "diabolo/diagnose/lone_fault.hpp"
#include "diabolo/diagnose/next_experiment.hpp"
#include "diabolo/diagnose/noise_trial.hpp"
#include "diabolo/diagnose/permuted_law.hpp"
#include "diabolo/diagnose/slack_catch.hpp"
#include "diabolo/diagnose/withdraw.hpp"

namespace diabolo {

namespace diagnose_detail {

/// One diagnosis, with every body under its name.
template <class D>
class Inquiry : public ClaimSearch<D> {
 public:
  using Search = ClaimSearch<D>;
  using Search::Search;

  Diagnosis answer() {
    this->read();
    if (result_.reason.empty()) this->fit_all();
    if (!result_.reason.empty()) {
      result_.model = options_.base;
    } else {
      widen_catch();
      settle();
      bool withdrawn = withdraw_what_does_not_help(result_, judged_);
      judge();
      withdrawn = learn_laws(withdrawn);
      withdrawn = withdrawn || withdraw_what_explains_too_little(result_);
      if (withdrawn) result_.model = without_claims(options_.base, physics_, fit_.at, result_.learnt);
      result_.heldout.whole_recordings = !options_.holdout.empty() || recordings_.size() > 1;
      compare_takes();
      ask_axle();
      finish();
      result_.final_fit = std::make_shared<FinalFit>(
          FinalFit{physics_, std::move(fit_), set_, possible(), axle_.at, axle_.deviation, !withdrawn});
    }
    std::ranges::copy(budget_.left(), std::back_inserter(result_.not_done));
    conclude(result_);
    return std::move(result_);
  }

 private:
  using Search::bank_, Search::before_, Search::budget_, Search::exchanged_, Search::fit_, Search::numerical_,
      Search::options_, Search::physics_, Search::recordings_, Search::result_, Search::set_, Search::step;

  /// Widens the rule for a catch where predictions ask for it, before they judge anything else.
  void widen_catch() {
    const char* const asking = "asking whether slack strings catch";
    if (!budget_.allows(asking, kFitsShare)) return;
    const FitWatch looking = step(asking, 0.85, 0.85, kFitsShare);
    result_.catch_rule = slack_catch(fit_, physics_, options_.seed, options_.threads, looking);
    if (looking.is_enough()) budget_.leave(asking);
    if (!result_.catch_rule) return;
    physics_.parameters.catch_slack = result_.catch_rule->catch_slack_m;
    refine<D>(fit_, physics_, set_, kMostIterations, options_.threads,
              step("refitting what is left", 0.85, 0.85));
  }

  /// Claims what stands, and takes back, one after the other, what data that were left out deny.
  void settle() {
    for (;;) {
      claim();
      const Candidate* denied = compare();
      for (const Candidate* candidate : denied_) say_denied(result_, *candidate);
      if (denied == nullptr) return;
      denied_.push_back(denied);
      const ActiveSet before = std::exchange(set_, with(set_, *denied, false));
      if ((set_ == before).all()) return;  // a wrap is not free, and stays
      put_at_rest(fit_, set_);
      refine<D>(fit_, physics_, set_, kMostIterations, options_.threads,
                step("refitting what is left", 0.85, 0.9, kTrialsShare));
    }
  }

  /// What data that were left out do not deny.
  Bank possible() const {
    Bank result = bank_;
    for (const Candidate* candidate : denied_) std::erase(result, candidate);
    return result;
  }

  void claim() {
    const Evidence evidence(fit_);
    result_.at = fit_.at;
    result_.model = augmented_model(physics_, fit_.at, "diagnosed", bank_);
    result_.findings.clear();
    result_.unexplained_forces.clear();
    find(result_, fit_, evidence, bank_, set_);
    if (!physics_.effects.template get<UnnamedForce>().neutral())
      result_.unexplained_forces.clear();  // they are told in units of the law that is there
    withdraw_what_cannot_be(result_);
    for (Finding& f : result_.findings) {
      for (const Replacement& exchange : exchanged_)
        if (f.claimed && f.candidate->name == exchange.name) f.tied_with = exchange.tied_with;
      for (const Candidate* candidate : denied_) std::erase(f.tied_with, candidate->name);
    }
    tie_with_physics(result_, evidence, bank_, set_);
    claim_lone_fault(result_, evidence, set_);
    if (std::ranges::none_of(fit_.fit_takes, has_spin) &&
        std::ranges::find(bank_, &candidate_of("string_friction")) != bank_.end())
      tie_tilt_with_friction(result_);
    withdraw_length_of_a_wrap(result_, estimates_of(evidence, set_));
    for (const Replacement& exchange : exchanged_)
      if (exchange.name == "string_wrap") claim_wraps(result_, fit_, exchange);
  }

  /// Compares on data left out, with all claims and without each; returns what these deny.
  const Candidate* compare() {
    std::vector<ActiveSet> without;
    for (const Finding& f : result_.findings)
      if (f.claimed) without.push_back(with(set_, *f.candidate, false));
    std::vector<HeldOutRecording> held = leave_out(fit_, Evidence(fit_), set_, without, options_.holdout);
    const Watch comparing = step("comparing on data left out", 0.85, 0.9);
    const auto against = [&](const Model& base) {
      return compare_held_out(held, base, physics_, options_.seed, fit_.most_windows, options_.threads,
                              comparing);
    };
    result_.heldout = judged_ = against(options_.base);
    if (result_.catch_rule) {  // what a wider rule gains is no merit of the claims
      Model base = options_.base;
      base.parameters.catch_slack = physics_.parameters.catch_slack;
      for (HeldOutRecording& one : held) one.without.clear();
      judged_ = against(base);
    }
    for (std::size_t i = 0; i < without.size() && !held.empty(); ++i) {  // claims come first
      result_.findings[i].worsening_ci95 = result_.heldout.position.worsening_ci95[i];
      result_.findings[i].spin_worsening_ci95 = result_.heldout.spin.worsening_ci95[i];
    }
    const Candidate* denied = withdraw_what_left_out_data_deny(result_);
    tie_tips_with_faults(result_, Evidence(fit_), bank_, set_);
    return denied != nullptr ? denied : withdraw_spin_that_does_not_help(result_, judged_);
  }

  /// Takes laws that were learnt from what is left into the model, one after the other. Returns whether what
  /// was found is withdrawn.
  bool learn_laws(bool withdrawn) {
    constexpr std::size_t kMost = 2;
    for (bool more = true; more && result_.learnt.size() < kMost;) {
      if (!budget_.allows("learning laws", kTrialsShare)) break;
      const FitWatch looking = step("learning laws", 0.9, 0.95, kTrialsShare);
      std::optional<LearntLaw> law =
          learn_law<D>(fit_, physics_, set_, bank_, result_.windows, options_, looking);
      if (looking.is_enough()) budget_.leave("learning laws");
      if (!law || looking.is_enough()) break;
      physics_ = std::move(law->physics);
      fit_ = std::move(law->fit);
      set_ = law->set;
      fit_.noise_is_known = false;  // what was not known was taken for noise
      refine<D>(fit_, physics_, set_, kMostIterations, options_.threads, looking);
      fit_.noise_is_known = true;
      add_what_it_hid(looking);
      ask_wraps_again<D>(fit_, set_, exchanged_, physics_, options_.threads, looking);
      if (looking.is_enough()) budget_.leave("learning laws");
      result_.learnt.push_back({.law = std::move(law->law),
                                .gain = law->gain,
                                .worsening_ci95 = std::move(law->worsening_ci95),
                                .spin_worsening_ci95 = std::move(law->spin_worsening_ci95)});
      settle();
      withdrawn = withdraw_what_does_not_help(result_, judged_);
      judge();
      more = !withdrawn && !result_.adequacy.adequate.value_or(true);
    }
    note_learnt(result_, physics_, fit_, set_);
    ask_dependences();
    return withdrawn;
  }

  /// Beside a law that was learnt a name may be sure that was not before.
  void add_what_it_hid(const FitWatch& watch) {
    const Candidate* hidden = strongest_left_out(Evidence(fit_), possible(), set_);
    if (hidden == nullptr || watch.is_enough()) return;
    set_ = with(set_, *hidden);
    refine<D>(fit_, physics_, set_, kMostIterations, options_.threads, watch);
  }

  /// Whether learnt laws depend on what they say.
  void ask_dependences() {
    const char* const asking = "permuting learnt laws";
    for (Learnt& learnt : result_.learnt) {
      if (!budget_.allows(asking, kTrialsShare)) return;
      const FitWatch looking = step(asking, 0.95, 0.955, kTrialsShare);
      learnt.dependence = dependence_of<D>(learnt.law, learnt.first, fit_, physics_, set_, options_.seed,
                                           options_.threads, looking);
      if (looking.is_enough()) budget_.leave(asking);
    }
  }

  /// Compares what is left with what noise alone would leave.
  void judge() {
    const char* const asking = "asking what noise alone would leave";
    result_.adequacy = {};  // of another fit
    if (!budget_.allows(asking, kRulesShare)) return;
    const FitWatch looking = step(asking, 0.95, 0.96, kRulesShare);
    std::vector<WindowFinding> windows = result_.windows;
    Adequacy found = adequacy_of<D>(windows, fit_, physics_, result_.heldout.ahead, options_.seed,
                                    options_.threads, looking);
    if (looking.is_enough()) return budget_.leave(asking);
    result_.windows = std::move(windows);
    result_.adequacy = std::move(found);
  }

  /// Asks each of several recordings by itself, of what all together deny as well: that may be since they do
  /// not agree.
  void compare_takes() {
    const char* const comparing = "comparing recordings";
    if (fit_.fit_takes.size() < 2 || !budget_.allows(comparing, kRulesShare)) return;
    const FitWatch looking = step(comparing, 0.96, 0.965, kRulesShare);
    ActiveSet asked = set_;
    for (const Candidate* candidate : denied_) asked = with(asked, *candidate);
    auto found = differing_takes<D>(fit_, physics_, bank_, asked, options_.threads, looking);
    if (looking.is_enough()) return budget_.leave(comparing);
    result_.differing = std::move(found);
  }

  /// Asks what turns the axle, with place and spin as they were found.
  void ask_axle() {
    const char* const asking = "asking what turns the axle";
    if (!options_.axle || !budget_.allows(asking, kRulesShare)) return;
    const FitWatch looking = step(asking, 0.965, 0.967, kRulesShare);
    const int radius = index_of(Unknown::kAxleRadius);
    const double radius_share = result_.deviation[radius] / std::max(fit_.at[radius], 1e-3);
    std::vector<Recording> showing;
    std::ranges::copy_if(options_.holdout, std::back_inserter(showing),
                         [](const Recording& r) { return !r.diabolo_orientation.empty(); });
    const Fit held = fit_starts<D>(showing, fit_, physics_, options_.threads, looking);
    axle_ =
        AxleInquiry(AxleStretches(fit_), AxleStretches(held), augmented_model(physics_, fit_.at, "diagnosed"),
                    axle_bank(options_.bank), radius_share, options_.threads, looking)
            .answer(options_.seed);
    if (looking.is_enough()) budget_.leave(asking);
    std::ranges::move(axle_.findings, std::back_inserter(result_.findings));
    surest_first(result_.findings);
    if (axle_.helps) result_.model = with_axle(result_.model, axle_.at);
    result_.heldout.axle = axle_.ahead;
  }

  /// Asks how much of what is left the base's numerical rules make.
  void compare_numerical_rules() {
    const char* const comparing = "comparing rules";
    if (!budget_.allows(comparing, kRulesShare)) return;
    const FitWatch looking = step(comparing, 0.967, 0.97, kRulesShare);
    Model rules = options_.base;
    rules.parameters.catch_slack = physics_.parameters.catch_slack;
    rules.effects.template get<UnnamedForce>() = physics_.effects.template get<UnnamedForce>();
    rules.effects.template get<FormulaLaws>() = physics_.effects.template get<FormulaLaws>();
    const auto share = compare_rules<D>(fit_, rules, physics_, options_.threads, looking);
    if (looking.is_enough()) return budget_.leave(comparing);
    result_.numerical = share;
  }

  /// Where it was before and after, the numerical rules' share, the noise, and what to record next.
  void finish() {
    remember_directions(result_, before_, fit_);
    if (numerical_) compare_numerical_rules();
    for (std::size_t s = 0; s < fit_.fit_takes.size(); ++s)
      result_.noise.push_back({fit_.fit_takes[s].take->recording.name, fit_.noise[s]});
    const char* const proposing = "proposing what to record next";
    if (!budget_.allows(proposing, 1.0)) return;
    const FitWatch looking = step(proposing, 0.97, 1.0);
    result_.proposals = next_experiments<D>(result_, fit_, physics_, set_, options_.threads, looking);
    if (looking.is_enough()) budget_.leave(proposing);
  }

  std::vector<const Candidate*> denied_;
  AxleAnswer axle_;
  HeldOut judged_;  ///< against the base with the rule for a catch that the model has
};

}  // namespace diagnose_detail
}  // namespace diabolo
