// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/alternatives.hpp"
#include "diabolo/diagnose/catch_bounce.hpp"
#include "diabolo/diagnose/diagnosis_options.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/first_fit.hpp"
#include "diabolo/diagnose/own_laws.hpp"
#include "diabolo/diagnose/refine.hpp"
#include "diabolo/diagnose/select.hpp"
#include "diabolo/diagnose/sufficient.hpp"
#include "diabolo/diagnose/thin.hpp"
#include "diabolo/diagnose/thin_axle.hpp"
#include "diabolo/diagnose/time_budget.hpp"

namespace diabolo {

namespace diagnose_detail {

/// What is not asked where no recording shows the spin.
inline constexpr const char* kUnseenSpinWords =
    "asking what acts on the spin or by it (air, bearing, the string's drive, lift): the recordings show no "
    "spin, and the friction of the string is fitted with a guessed one";

/// From recordings to a fit of what is sure: reads them, fits everything that may be missing, keeps what is
/// sure, and exchanges it for what explains more. The first half of a diagnosis.
template <class D>
class ClaimSearch {
 public:
  ClaimSearch(const std::vector<Recording>& recordings, const DiagnosisOptions& options,
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
    result_.base_spin_coupling = physics_.parameters.spin_coupling;
    result_.base_string_length = parameters_for(physics_, recordings.front()).string_length;
  }

  /// Whether friction would have to give energy.
  bool backwards() const { return backwards_; }

 protected:
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
    begin_with(fit_, step("fitting starts", 0.05, 0.15));
  }

  /// Fits the starts of the base alone, and takes down what it leaves.
  void begin_with(Fit& base, const FitWatch& watch) {
    refine<D>(base, physics_, ActiveSet::Constant(false), 2, options_.threads, watch);
    result_.windows.clear();
    remember_before(result_, base);
    before_ = base.systems;
  }

  /// Fits everything, keeps what is sure and exchanges it for what explains more. Another delay or rate than
  /// thought at first changes what all else looks like, as do springs so soft that it bounces: all is asked
  /// again.
  void fit_all() {
    set_ = asked_at_first(bank_);
    if (std::ranges::none_of(fit_.fit_takes, has_spin)) {
      without_spin(bank_, set_);
      result_.not_done.emplace_back(kUnseenSpinWords);
    }
    for (bool again = false;; again = true) {
      if (!fit_bank(again)) {
        result_.reason = "the budget of " + shown(options_.budget) +
                         " s is spent before anything fits; more time is needed";
        result_.windows.clear();
        return;
      }
      keep_what_is_sure(again);
      if (!is_delayed()) try_bounce(again);
      if (!again && try_thin_axle()) {
        ask_again(false);
        continue;
      }
      const auto clock = [&] { return std::pair(fit_.delay, set_[index_of(Unknown::kGravity)]); };
      const auto before = clock();
      exchange(again);
      const bool soft = !fit_.bounces && is_bouncy(give_of(physics_.effects) + added_give(fit_.at));
      if ((clock() == before && !soft) || !budget_.allows("asking all again with what was found", kFitsShare))
        return try_bounce(again);
      ask_again(soft);
    }
  }

  /// Whether it was done in time; again, from what was found, it is no loss where it was not.
  bool fit_bank(bool again) {
    const FitWatch everything = step("fitting everything", again ? 0.6 : 0.15, again ? 0.7 : 0.4, kFitsShare);
    if (again)  // starts that bounce, or are late, are others
      approach<D>(fit_, physics_, ActiveSet::Constant(false), 3, options_.threads, everything);
    const bool in_time = std::ranges::all_of(fit_.fit_takes, has_spin) || again
                             ? fit_everything<D>(fit_, physics_, set_, options_.threads, everything)
                             : fit_unseen_spin<D>(fit_, physics_, set_, options_.threads, everything);
    return again || in_time;
  }

  void keep_what_is_sure(bool again) {
    const Candidate& friction = candidate_of("string_friction");
    backwards_ =
        is_in(set_, friction) && significance(friction, estimates_of(Evidence(fit_), set_)) < -kSignificance;
    set_ = eliminate(Evidence(fit_), bank_, set_);
    for (int round = 0;; ++round) {
      const double begin = (again ? 0.7 : 0.4) + 0.03 * round;
      const FitWatch refitting = step("refitting what is sure", begin, begin + 0.03, kFitsShare);
      const Fit before = fit_;
      refit(refitting);
      take_spring_back(before, refitting);
      const Evidence evidence(fit_);
      ActiveSet next = eliminate(evidence, bank_, set_);
      if (const Candidate* candidate = strongest_left_out(evidence, bank_, next))
        next = with(next, *candidate);
      if ((next == set_).all() || round == 2 || !budget_.allows("asking again what is sure", kFitsShare))
        return;  // judged at its own fit
      set_ = next;
    }
  }

  /// Fits what is in the set. Where a spring loses most of what gave on the way, it is begun again with all
  /// of it.
  void refit(const FitWatch& watch) {
    const double together = added_give(fit_.at);
    std::optional<Fit> alone = giving_alone(fit_, set_);
    put_at_rest(fit_, set_);
    refine<D>(fit_, physics_, set_, kMostIterations, options_.threads, watch);
    if (!alone || added_give(fit_.at) > kLostGive * together) return;
    refine<D>(*alone, physics_, set_, kMostIterations, options_.threads, watch);
    const auto [theirs, ours] = costs_where_both_fit(with_noise_of(fit_, *alone, options_.threads), fit_);
    if (theirs < ours) fit_ = *std::move(alone);
  }

  /// Takes a spring back that was let go, where it costs clearly less.
  void take_spring_back(const Fit& before, const FitWatch& watch) {
    auto sprung = with_spring_again<D>(fit_, before, set_, bank_, physics_, options_.threads, watch);
    if (sprung) std::tie(fit_, set_) = *std::move(sprung);
  }

  /// Whether the recordings are rather of a string that lies around no axle; the fit is moved to it then.
  bool try_thin_axle() {
    const char* const trying = "trying a string around no axle";
    if (!may_be_thin(fit_, set_, physics_) || !budget_.allows(trying, kFitsShare)) return false;
    const FitWatch watched = step(trying, 0.49, 0.5, kFitsShare);
    std::optional<Fit> trial = with_thin_axle<D>(fit_, set_, physics_, options_.threads, watched);
    if (watched.is_enough()) budget_.leave(trying);
    if (!trial || watched.is_enough()) return false;
    fit_ = *std::move(trial);
    Fit base = begun_thin(fit_, physics_);
    begin_with(base, step(trying, 0.5, 0.5));
    return true;
  }

  /// Whether the diabolo is late, which makes a catch look like a bounce.
  bool is_delayed() const {
    const Candidate& late = candidate_of("time_offset");
    return speaks_for(late, significance(late, estimates_of(Evidence(fit_), set_)));
  }

  /// Has catches bounce where that explains more, and stays with all else that is sure.
  void try_bounce(bool again) {
    const char* const trying = "trying catches that bounce";
    const Candidate& bounce = candidate_of("landing_restitution");
    if (std::ranges::find(bank_, &bounce) == bank_.end() || is_in(set_, bounce) ||
        std::ranges::none_of(result_.windows, &WindowFinding::eventful) ||
        !budget_.allows(trying, kFitsShare))
      return;
    const double begin = again ? 0.8 : 0.5;
    const FitWatch watched = step(trying, begin, begin, kFitsShare);
    auto trial = bouncing<D>(fit_, set_, physics_, options_.threads, watched);
    if (watched.is_enough()) budget_.leave(trying);
    if (!trial) return;
    std::swap(fit_, trial->first);
    std::swap(set_, trial->second);
    fit_.noise_is_known = false;
    keep_what_is_sure(again);
    if (!is_in(set_, bounce)) std::tie(fit_, set_) = *std::move(trial);
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
      const std::string_view other_than = alternative_to(e.name);
      return e.name != "string_wrap" && other_than != "time_offset" && other_than != "length_scale";
    });
    for (const Candidate* candidate : bank_)
      if (candidate->kind == CandidateKind::kPhysics && first_of(*candidate) != Unknown::kRestitution)
        set_ = with(set_, *candidate);
    if (std::ranges::none_of(fit_.fit_takes, has_spin)) without_spin(bank_, set_);
  }

  const std::vector<Recording>& recordings_;
  const DiagnosisOptions& options_;
  const DiagnosisWatch& watch_;
  TimeBudget budget_;
  bool numerical_;
  Model physics_;
  Bank bank_;
  Fit fit_;
  std::vector<WindowSystem> before_;  ///< of the base alone
  ActiveSet set_ = ActiveSet::Constant(false);
  std::vector<Replacement> exchanged_;
  bool backwards_ = false;
  Diagnosis result_;
};

}  // namespace diagnose_detail
}  // namespace diabolo
