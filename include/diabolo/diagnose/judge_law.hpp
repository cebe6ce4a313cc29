// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "diabolo/diagnose/diagnosis_options.hpp"
#include "diabolo/diagnose/folds.hpp"
#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/diagnose/left_out_says.hpp"
#include "diabolo/diagnose/select.hpp"
#include "diabolo/diagnose/significance.hpp"

namespace diabolo {

/// A law is learnt where chi^2 falls by so much, in units of the dispersion: twice what a name needs, since
/// many guesses are asked about.
/// (Beside that it must matter, explain windows that were left out, and help predictions of them.)
inline constexpr double kGainOfLaw = 2.0 * kSignificance * kSignificance;

/// A law explains at least this share of what noise alone would not leave, together with what laws with a
/// name had explained that it displaces. What explains less is another.
inline constexpr double kShareOfLaw = 0.25;

/// Each number beyond a law's amplitude has to bring this share of its gain.
inline constexpr double kPriceOfNumber = 0.05;

/// So much of it may stand alone where predictions cannot tell.
inline constexpr double kGainAlone = 10.0 * kGainOfLaw;

/// A law that was learnt and the fit with it.
struct LearntLaw {
  Law law;
  std::size_t first = 0;  ///< place of its first number among those of the model's laws
  Model physics;          ///< the base of the fit
  Fit fit;
  ActiveSet set = ActiveSet::Constant(false);
  double gain = 0.0;       ///< what chi^2 falls by, in units of the dispersion
  double inherited = 0.0;  ///< what laws with a name, which it displaces, had explained of chi^2
  std::vector<std::optional<Interval>> worsening_ci95{}, spin_worsening_ci95{};  ///< see Finding
};

namespace diagnose_detail {

/// What is free beside a law.
inline ActiveSet without(const LearntLaw& learnt) {
  ActiveSet result = learnt.set;
  for (std::size_t i = 0; i < learnt.law.numbers.size(); ++i)
    result[index_of(own_number(learnt.first + i))] = false;
  return result;
}

/// Part of chi^2, of positions or of the spin, that noise alone would not leave; `windows` hold what it
/// would.
inline double beyond_noise(const Fit& fit, const std::vector<WindowFinding>& windows, bool of_spin) {
  double sum = 0.0;
  std::size_t i = 0;
  for (std::size_t s = 0; s < fit.fit_takes.size(); ++s)
    for (std::size_t w = 0; w < fit.fit_takes[s].windows.size(); ++w, ++i) {
      const WindowFinding& window = windows[i];
      const double left = of_spin ? window.spin_after : window.residual_after,
                   noise = of_spin ? window.spin_noise : window.residual_noise;
      if (!(left > noise)) continue;
      const double of_spins = fit.systems[i].spin_square / std::pow(fit.noise[s].spin, 2),
                   of_positions = fit.systems[i].position_square / std::pow(fit.noise[s].position, 2),
                   share = (of_spin ? of_spins : of_positions) / (of_spins + of_positions);
      const WindowScore& score = fit.scores[i];
      sum += score.weight * score.chi_square * share * (1.0 - std::pow(noise / left, 2));
    }
  return sum;
}

/// The least that a law which is at work explains of what `fit` leaves, in chi^2.
inline double least_explained(const Fit& fit, const std::vector<WindowFinding>& windows, Acts acts) {
  return kShareOfLaw * beyond_noise(fit, windows, acts == Acts::kSpin);
}

/// Whether a law explains as much as one that is at work would. One that displaces a named one explains what
/// that did, too: its gain is only the difference between the two.
inline bool explains_enough(const LearntLaw& learnt, const Fit& before,
                            const std::vector<WindowFinding>& windows) {
  const double explained = learnt.gain * learnt.fit.dispersion + learnt.inherited;
  return learnt.gain > kGainOfLaw &&
         explained > least_explained(before, windows, learnt.law.acts) + kShareOfLaw * learnt.inherited;
}

/// The gain less what its numbers cost, beyond those of a fit of `set` that stood in its place.
inline double worth(const LearntLaw& learnt, const ActiveSet& set) {
  const auto more = static_cast<double>(learnt.set.count() - set.count() - 1);
  return learnt.gain * (1.0 - kPriceOfNumber * more);
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
  const LeftOutSays position(learnt.worsening_ci95, kImmaterialPosition),
      spin(learnt.spin_worsening_ci95, kImmaterialSpin),
      &judge = learnt.law.acts == Acts::kSpin ? spin : position;
  return position.worse == 0 && spin.worse == 0 &&
         (judge.better > 0 || (learnt.gain > kGainAlone && judge.leaning >= 0.0));
}

}  // namespace diagnose_detail

}  // namespace diabolo
