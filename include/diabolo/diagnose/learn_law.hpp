// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "diabolo/diagnose/diagnosis_options.hpp"
#include "diabolo/diagnose/fast_swings.hpp"
#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/diagnose/law_guesses.hpp"
#include "diabolo/diagnose/left_out_says.hpp"
#include "diabolo/diagnose/refine.hpp"
#include "diabolo/diagnose/select.hpp"
#include "diabolo/diagnose/significance.hpp"

namespace diabolo {

/// A law is learnt where chi^2 falls by so much, in units of the dispersion: twice what a name needs, since
/// many guesses are asked about.
/// (Beside that it must matter, explain windows that were left out, and help predictions of them.)
inline constexpr double kGainOfLaw = 2.0 * kSignificance * kSignificance;

/// So much of it may stand alone where predictions cannot tell.
inline constexpr double kGainAlone = 10.0 * kGainOfLaw;

/// A guess is fitted that promises so much: what stands in a law's place may hide some of it.
inline constexpr double kGainOfGuess = kSignificance * kSignificance;

/// A law that was learnt and the fit with it.
struct LearntLaw {
  Law law;
  std::size_t first = 0;  ///< place of its first number among those of the model's laws
  Model physics;          ///< the base of the fit
  Fit fit;
  ActiveSet set = ActiveSet::Constant(false);
  double gain = 0.0;  ///< what chi^2 falls by, in units of the dispersion
  std::vector<std::optional<Interval>> worsening_ci95{}, spin_worsening_ci95{};  ///< see Finding
};

namespace diagnose_detail {

inline std::size_t numbers_of(const FormulaLaws<double>& laws) {
  std::size_t count = 0;
  laws.each([&](const Law& law, std::size_t) { count += law.numbers.size(); });
  return count;
}

/// The model with more laws, which do nothing yet.
inline Model with_laws(Model physics, const std::vector<Law>& more) {
  auto& own = physics.effects.get<FormulaLaws>();
  std::vector<Law> laws = own.laws ? *own.laws : std::vector<Law>{};
  int number = 1;
  for (Law law : more) {
    do law.name = "learnt_" + std::to_string(number++);
    while (std::ranges::find(laws, law.name, &Law::name) != laws.end());
    laws.push_back(std::move(law));
  }
  FormulaLaws<double> result(std::move(laws));
  std::copy_n(own.numbers.begin(), numbers_of(own), result.numbers.begin());
  own = std::move(result);
  return physics;
}

/// What is free beside a law.
inline ActiveSet without(const LearntLaw& learnt) {
  ActiveSet result = learnt.set;
  for (std::size_t i = 0; i < learnt.law.numbers.size(); ++i)
    result[index_of(own_number(learnt.first + i))] = false;
  return result;
}

/// A guess with what the windows say of its probes, all else free that is.
struct ScoredGuess {
  const LawGuess* guess;
  double gain;                ///< see LearntLaw
  std::vector<double> sizes;  ///< of the probes, in SI units
};

/// The best guesses, which may be fitted, no law twice: windows are asked about as many at once as there is
/// room for.
template <class D>
std::vector<ScoredGuess> best_guesses(const std::vector<LawGuess>& guesses, const Fit& fit,
                                      const Model& physics, const ActiveSet& set, std::size_t most,
                                      int threads, const FitWatch& watch) {
  const std::size_t used = numbers_of(physics.effects.get<FormulaLaws>()), room = Law::kMostNumbers - used;
  std::vector<ScoredGuess> result;
  for (std::size_t begin = 0; begin < guesses.size() && !watch.is_enough();) {
    std::vector<Law> probes;
    std::size_t end = begin;
    while (end < guesses.size() && probes.size() + guesses[end].probes.size() <= room) {
      probes.insert(probes.end(), guesses[end].probes.begin(), guesses[end].probes.end());
      ++end;
    }
    if (end == begin) {  // no room for it
      ++begin;
      continue;
    }
    ActiveSet asked = set;
    for (std::size_t i = 0; i < probes.size(); ++i) asked[index_of(own_number(used + i))] = true;
    Fit looked = fit;
    linearize<D>(looked, with_laws(physics, probes), asked, threads, watch);
    const Evidence evidence(looked);
    for (std::size_t own = used; begin < end; ++begin) {
      ActiveSet more = set;
      for (std::size_t i = 0; i < guesses[begin].probes.size(); ++i)
        more[index_of(own_number(own + i))] = true;
      const double gain = (evidence.cost(set) - evidence.cost(more)) / evidence.dispersion();
      ScoredGuess guess{&guesses[begin], gain, {}};
      const UnknownVector at = evidence.solve(more);
      for (const Law& probe : guesses[begin].probes)
        guess.sizes.push_back(at[index_of(own_number(own++))] * probe.numbers.front().usual);
      result.push_back(std::move(guess));
    }
  }
  std::ranges::stable_sort(result, std::greater(), &ScoredGuess::gain);
  std::vector<ScoredGuess> best;
  for (ScoredGuess& one : result) {
    const Law& law = one.guess->law;
    const bool tried = std::ranges::any_of(best, [&](const ScoredGuess& other) {
      return other.guess->law.acts == law.acts && other.guess->law.formula.text() == law.formula.text();
    });
    if (best.size() < most && one.gain > kGainOfGuess && !tried && law.numbers.size() <= room)
      best.push_back(std::move(one));
  }
  return best;
}

/// Oscillations too fast for windows to follow.
template <class D>
std::vector<LawGuess> fast_guesses(const Fit& fit, const Model& physics, const ActiveSet& set, int threads,
                                   const FitWatch& watch) {
  const std::size_t used = numbers_of(physics.effects.get<FormulaLaws>());
  return fast_swings(fit, used, Law::kMostNumbers - used, [&](const std::vector<Law>& probes) {
    ActiveSet asked = set;
    for (std::size_t i = 0; i < probes.size(); ++i) asked[index_of(own_number(used + i))] = true;
    Fit looked = fit;
    linearize<D>(looked, with_laws(physics, probes), asked, threads, watch);
    return looked;
  });
}

/// Fits a guess from where its probes are, with its shape, and with what is sure beside it.
template <class D>
LearntLaw fitted(const ScoredGuess& scored, const Fit& fit, const Model& physics, const ActiveSet& set,
                 const Bank& bank, int threads, const FitWatch& watch) {
  LearntLaw result{scored.guess->law, numbers_of(physics.effects.get<FormulaLaws>()), physics, fit, set};
  std::vector<LawNumber>& numbers = result.law.numbers;
  double size = scored.sizes.front();
  if (scored.sizes.size() == 2) {  // sine and cosine
    size = std::hypot(scored.sizes[0], scored.sizes[1]);
    numbers.back().expected = std::atan2(scored.sizes[1], scored.sizes[0]);
  }
  numbers.front().usual = std::max(std::abs(size), 1e-3 * numbers.front().usual);
  result.physics = with_laws(physics, {result.law});
  result.law = result.physics.effects.get<FormulaLaws>().laws->back();
  for (std::size_t i = 0; i < numbers.size(); ++i) result.set[index_of(own_number(result.first + i))] = true;
  result.fit.at[index_of(own_number(result.first))] = std::copysign(1.0, size);
  approach<D>(result.fit, result.physics, result.set, kMostIterations, threads, watch);
  const ActiveSet kept = eliminate(Evidence(result.fit), bank, result.set);
  if ((kept != result.set).any()) {  // a law with a name stood in its place
    result.set = kept;
    put_at_rest(result.fit, kept);
    approach<D>(result.fit, result.physics, kept, kMostIterations, threads, watch);
  }
  result.gain = (fit.cost - result.fit.cost) / result.fit.dispersion;
  return result;
}

/// Whether a law moves the diabolo, or its spin, by as much as matters.
inline bool matters(const LearntLaw& learnt) {
  Candidate own{learnt.law.name, "", CandidateKind::kPhysics, {own_number(learnt.first)}, 0.0, false};
  own.law = &learnt.law;
  const double least = is_of_spin(own) ? kSmallestSpinShare : kSmallestReach;
  return size_of(own, learnt.fit.at, learnt.fit.systems) > least;
}

/// Whether a fit is sure of all its laws by formulas: of two that do the same it is of neither.
inline bool is_sure_of_laws(const LearntLaw& learnt) {
  const Estimates now = estimates_of(Evidence(learnt.fit), learnt.set);
  bool sure = true;
  learnt.physics.effects.get<FormulaLaws>().each([&](const Law&, std::size_t first) {
    const int size = index_of(own_number(first));
    if (learnt.set[size]) sure = sure && std::abs(now.estimate[size]) > kSignificance * now.deviation(size);
  });
  return sure;
}

/// Whether it may as well be a law that has a name: by its power, within two standard deviations.
inline bool may_have_a_name(const LearntLaw& learnt, const std::vector<double>& named_powers) {
  if (named_powers.empty()) return false;
  const int u = index_of(own_number(learnt.first + 1));
  const LawNumber& power = learnt.law.numbers[1];
  const double value = power.expected + power.usual * learnt.fit.at[u],
               reach = 2.0 * power.usual * estimates_of(Evidence(learnt.fit), learnt.set).deviation(u);
  return std::ranges::any_of(named_powers, [&](double named) { return std::abs(value - named) < reach; });
}

/// Whether windows that were left out, fold by fold, fit better with a law. Position and spin count.
inline bool explains_left_out(const LearntLaw& learnt) {
  const Evidence evidence(learnt.fit);
  const ActiveSet less = without(learnt);
  double gain = 0.0;
  for (const Fold& fold : folds_of(learnt.fit.fit_takes)) {
    const std::vector<bool> left_out = windows_in(fold, learnt.fit.fit_takes);
    gain += evidence.cost_left_out(less, left_out) - evidence.cost_left_out(learnt.set, left_out);
  }
  return gain > 0.0;
}

/// Whether data that were left out are predicted better with a law than by the fit `before`, of `set`, and
/// nowhere worse: the spin, by a law that acts on it; else positions. Where they are few and cannot tell,
/// much of chi^2 is enough, if they do not lean against it. Notes by how much they are predicted better.
inline bool helps(LearntLaw& learnt, const Fit& before, const ActiveSet& set, const DiagnosisOptions& options,
                  const FitWatch& watch) {
  std::vector<HeldOutRecording> held =
      leave_out(learnt.fit, Evidence(learnt.fit), learnt.set, {}, options.holdout);
  const std::vector<HeldOutRecording> old = leave_out(before, Evidence(before), set, {}, options.holdout);
  for (std::size_t i = 0; i < held.size(); ++i) held[i].without = {old[i].at};
  const HeldOut compared = compare_held_out(held, options.base, learnt.physics, options.seed,
                                            learnt.fit.most_windows, options.threads, watch);
  if (compared.position.worsening_ci95.empty()) return false;
  learnt.worsening_ci95 = compared.position.worsening_ci95.front();
  learnt.spin_worsening_ci95 = compared.spin.worsening_ci95.front();
  const LeftOutSays position(learnt.worsening_ci95), spin(learnt.spin_worsening_ci95),
      &judge = learnt.law.acts == Acts::kSpin ? spin : position;
  return position.worse == 0 && spin.worse == 0 &&
         (judge.better > 0 || (learnt.gain > kGainAlone && judge.leaning >= 0.0));
}

}  // namespace diagnose_detail

/// The law that leaves least of what is left over, if windows that were left out say that it is there; fitted
/// with what is sure beside it. Of the best guesses some are fitted. `windows` hold what they say of the fit.
template <class D>
std::optional<LearntLaw> learn_law(const Fit& fit, const Model& physics, const ActiveSet& set,
                                   const Bank& bank, const std::vector<WindowFinding>& windows,
                                   const DiagnosisOptions& options, const FitWatch& watch) {
  constexpr std::size_t kMostFits = 4;
  constexpr double kMayOvertake = 4.0;  // a shape of its own may bring so many times what a guess promises
  std::vector<LawGuess> guesses = law_guesses(fit, windows);
  if (fit.fit_takes.size() == 1)
    std::ranges::move(diagnose_detail::fast_guesses<D>(fit, physics, set, options.threads, watch),
                      std::back_inserter(guesses));
  leave_out_unseen(guesses, fit);
  std::vector<LearntLaw> trials;
  for (const auto& scored :
       diagnose_detail::best_guesses<D>(guesses, fit, physics, set, kMostFits, options.threads, watch)) {
    if (!trials.empty() && kMayOvertake * scored.gain < trials.front().gain) break;
    LearntLaw trial = diagnose_detail::fitted<D>(scored, fit, physics, set, bank, options.threads, watch);
    if (watch.is_enough()) return std::nullopt;  // it may not have settled
    if (trial.gain > kGainOfLaw && diagnose_detail::matters(trial) &&
        diagnose_detail::is_sure_of_laws(trial) && diagnose_detail::explains_left_out(trial) &&
        !diagnose_detail::may_have_a_name(trial, scored.guess->named_powers))
      trials.push_back(std::move(trial));
  }
  std::ranges::stable_sort(trials, std::greater(), &LearntLaw::gain);
  for (LearntLaw& trial : trials)
    if (diagnose_detail::helps(trial, fit, set, options, watch)) return std::move(trial);
  return std::nullopt;
}

}  // namespace diabolo
