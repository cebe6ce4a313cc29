// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "diabolo/diagnose/evidence.hpp"
#include "diabolo/diagnose/heldout.hpp"
#include "diabolo/diagnose/learn_law.hpp"

namespace diabolo {

namespace diagnose_detail {

/// How strong a law is in each window, in units of a constant one in its direction: its response over the
/// constant one's.
inline std::vector<double> strengths(const Fit& fit, Unknown law, Unknown constant) {
  std::vector<double> result;
  for (const WindowScore& score : fit.scores) {
    const double own = score.information(index_of(constant), index_of(constant));
    result.push_back(own > 1e-9 ? score.information(index_of(law), index_of(constant)) / own : 0.0);
  }
  return result;
}

/// What chi^2 of left-out windows falls by, in units of the dispersion, once `law` is free beside `others`.
inline double gain_left_out(const Evidence& evidence, const std::vector<Fold>& folds,
                            const std::vector<FitTake>& takes, const ActiveSet& others, Unknown law) {
  ActiveSet more = others;
  more[index_of(law)] = true;
  double gain = 0.0;
  for (const Fold& fold : folds) {
    const std::vector<bool> left_out = windows_in(fold, takes);
    gain += evidence.cost_left_out(others, left_out) - evidence.cost_left_out(more, left_out);
  }
  return gain / evidence.dispersion();
}

}  // namespace diagnose_detail

/// Whether a law depends on what its formula says: what windows that were left out gain by it, window by
/// window as strong as it says, against what they gain where these strengths are exchanged among the windows
/// at random (Good, "Permutation, Parametric and Bootstrap Tests of Hypotheses", 2005, chapter 3). `set`:
/// what is free in the fit, whose law begins with number `first`. Nothing where the law is as strong in all
/// windows, where it changes within them too fast to be told by their strengths, or without room to ask.
template <class D>
std::optional<Dependence> dependence_of(const Law& law, std::size_t first, const Fit& fit,
                                        const Model& physics, const ActiveSet& set, std::uint64_t seed,
                                        int threads, const FitWatch& watch) {
  constexpr int kPermutations = 199;
  constexpr double kAsStrong = 0.05;  // a spread of the strengths, over their mean size
  const std::size_t used = diagnose_detail::numbers_of(physics.effects.get<FormulaLaws>());
  if (used >= Law::kMostNumbers) return std::nullopt;
  const Unknown own = own_number(first), constant = own_number(used);
  LawNumber size = law.numbers.front();
  size.name = "size";
  ActiveSet others = set, asked = set;
  for (std::size_t i = 0; i < law.numbers.size(); ++i) others[index_of(own_number(first + i))] = false;
  asked[index_of(constant)] = true;
  Fit looked = fit;
  linearize<D>(looked, diagnose_detail::with_laws(physics, {{"learnt", "", law.acts, "size", {size}}}), asked,
               threads, watch);
  if (watch.is_enough()) return std::nullopt;
  const std::vector<double> said = diagnose_detail::strengths(looked, own, constant);
  const double count = static_cast<double>(said.size()),
               mean = std::accumulate(said.begin(), said.end(), 0.0) / count;
  double square = 0.0, spread = 0.0;
  for (const double strength : said) {
    square += strength * strength / count;
    spread += (strength - mean) * (strength - mean) / count;
  }
  if (!(spread > kAsStrong * kAsStrong * square)) return std::nullopt;
  const Evidence evidence(looked);
  const std::vector<Fold> folds = folds_of(looked.fit_takes);
  const auto gain_of = [&](const std::vector<double>& factors) {
    return diagnose_detail::gain_left_out(evidence.rescaled(constant, factors), folds, looked.fit_takes,
                                          others, constant);
  };
  Dependence result{.gain = gain_of(said), .permuted = kNaN, .p_value = kNaN};
  if (2.0 * result.gain < diagnose_detail::gain_left_out(evidence, folds, looked.fit_takes, others, own))
    return std::nullopt;
  std::mt19937_64 generator(seed);
  std::vector<double> permuted = said, gains;
  for (int i = 0; i < kPermutations; ++i) {
    if (watch.is_enough()) return std::nullopt;
    std::ranges::shuffle(permuted, generator);
    gains.push_back(gain_of(permuted));
  }
  const auto better = std::ranges::count_if(gains, [&](double gain) { return gain >= result.gain; });
  result.p_value = static_cast<double>(better + 1) / (kPermutations + 1);
  std::ranges::sort(gains);
  result.permuted = quantile(gains, 0.5);
  return result;
}

}  // namespace diabolo
