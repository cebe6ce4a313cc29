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
#include "diabolo/diagnose/judge_law.hpp"
#include "diabolo/diagnose/law_guesses.hpp"
#include "diabolo/diagnose/refine.hpp"
#include "diabolo/diagnose/select.hpp"

namespace diabolo {

/// A guess is fitted that promises so much: what stands in a law's place may hide some of it.
inline constexpr double kGainOfGuess = kSignificance * kSignificance;

/// So many times what a guess promises its law may gain by a shape of its own.
inline constexpr double kMayOvertake = 4.0;

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

/// What laws with a name that `set` has and `kept` has not explain of a fit's chi^2.
inline double explained_by_laws(const Fit& fit, const Bank& bank, const ActiveSet& set,
                                const ActiveSet& kept) {
  ActiveSet less = set;
  for (const Candidate* candidate : bank)
    if (is_law(*candidate) && is_in(set, *candidate) && !is_in(kept, *candidate))
      less = with(less, *candidate, false);
  const Evidence evidence(fit);
  return evidence.cost(less) - evidence.cost(set);
}

/// Fits a law again beside `kept` of what was free, from a fit `before` of `set`: it displaces the rest.
template <class D>
void displace(LearntLaw& learnt, const ActiveSet& kept, const Fit& before, const ActiveSet& set,
              const Bank& bank, int threads, const FitWatch& watch) {
  learnt.inherited = explained_by_laws(before, bank, set, kept);
  learnt.set = kept;
  put_at_rest(learnt.fit, kept);
  approach<D>(learnt.fit, learnt.physics, kept, kMostIterations, threads, watch);
  learnt.gain = (before.cost - learnt.fit.cost) / learnt.fit.dispersion;
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
  result.gain = (fit.cost - result.fit.cost) / result.fit.dispersion;
  const ActiveSet kept = eliminate(Evidence(result.fit), bank, result.set);
  if ((kept != result.set).any())  // something with a name stood in its place
    displace<D>(result, kept, fit, set, bank, threads, watch);
  return result;
}

/// The law with a name that is least sure beside a learnt one; null where there is none.
inline const Candidate* weakest_law(const LearntLaw& learnt, const Bank& bank) {
  const Estimates now = estimates_of(Evidence(learnt.fit), learnt.set);
  const Candidate* weakest = nullptr;
  double least = 0.0;
  for (const Candidate* candidate : bank) {
    if (!is_law(*candidate) || !is_in(learnt.set, *candidate)) continue;
    const double sure = in_favour(*candidate, significance(*candidate, now));
    if (weakest == nullptr || sure < least) weakest = candidate, least = sure;
  }
  return weakest;
}

}  // namespace diagnose_detail

/// The law that leaves least of what is left over, if windows that were left out say that it is there; fitted
/// with what is sure beside it. Of the best guesses some are fitted. `windows` hold what they say of the fit.
template <class D>
std::optional<LearntLaw> learn_law(const Fit& fit, const Model& physics, const ActiveSet& set,
                                   const Bank& bank, const std::vector<WindowFinding>& windows,
                                   const DiagnosisOptions& options, const FitWatch& watch) {
  constexpr std::size_t kMostFits = 4;
  std::vector<LawGuess> guesses = law_guesses(fit, windows);
  if (fit.fit_takes.size() == 1)
    std::ranges::move(diagnose_detail::fast_guesses<D>(fit, physics, set, options.threads, watch),
                      std::back_inserter(guesses));
  leave_out_unseen(guesses, fit);
  std::vector<LearntLaw> trials;
  const auto best =
      diagnose_detail::best_guesses<D>(guesses, fit, physics, set, kMostFits, options.threads, watch);
  for (const auto& scored : best) {
    // What promises most is fitted in any case: where others stand in its place, it may gain far more.
    const double at_best = kMayOvertake * scored.gain,
                 least = diagnose_detail::least_explained(fit, windows, scored.guess->law.acts);
    if (scored.guess != best.front().guess && at_best * fit.dispersion < least) continue;
    if (!trials.empty() && at_best < trials.front().gain) break;
    LearntLaw trial = diagnose_detail::fitted<D>(scored, fit, physics, set, bank, options.threads, watch);
    const auto stands = [&] {
      return diagnose_detail::explains_enough(trial, fit, windows) && diagnose_detail::matters(trial) &&
             diagnose_detail::is_sure_of_laws(trial) &&
             !diagnose_detail::may_have_a_name(trial, scored.guess->named_powers);
    };
    // Beside a named law that does nearly the same it may explain nothing left out: then it is tried alone.
    if (stands() && !diagnose_detail::explains_left_out(trial))
      if (const Candidate* other = diagnose_detail::weakest_law(trial, bank))
        diagnose_detail::displace<D>(trial, with(trial.set, *other, false), fit, set, bank, options.threads,
                                     watch);
    if (watch.is_enough()) return std::nullopt;  // it may not have settled
    if (stands() && diagnose_detail::explains_left_out(trial)) trials.push_back(std::move(trial));
  }
  std::ranges::stable_sort(trials, std::greater(),
                           [&](const LearntLaw& law) { return diagnose_detail::worth(law, set); });
  for (LearntLaw& trial : trials)
    if (diagnose_detail::helps(trial, fit, set, options, watch)) return std::move(trial);
  return std::nullopt;
}

}  // namespace diabolo
