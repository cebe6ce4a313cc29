// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/diagnose/final_fit.hpp"
#include "diabolo/diagnose/learn_law.hpp"
#include "diabolo/diagnose/result_of.hpp"
#include "diabolo/diagnose/simulator_comparison.hpp"

namespace diabolo {

namespace diagnose_detail {

/// What a fit says of a law that another one learnt.
struct SizeOfLaw {
  double value, deviation;  ///< of its first number; the others are as they were learnt
  double reach;             ///< how far one unit of it moves the diabolo, see size_of()
};

/// Nothing where there is no room for its numbers.
template <class D>
std::optional<SizeOfLaw> size_in(const FinalFit& other, const Learnt& learnt, int threads,
                                 const Watch& watch) {
  const std::size_t used = numbers_of(other.physics.effects.get<FormulaLaws>());
  if (used + learnt.law.numbers.size() > Law::kMostNumbers) return std::nullopt;
  Law law = learnt.law;
  law.name = "of_the_other";
  for (std::size_t i = 1; i < law.numbers.size(); ++i) law.numbers[i].expected = learnt.value[i];
  Candidate own{law.name, "", CandidateKind::kPhysics, {own_number(used)}, 0.0, false};
  own.law = &law;
  const ActiveSet free = with(other.free, own);
  Fit asked = other.fit;
  linearize<D>(asked, with_laws(other.physics, {law}), free, threads, watch);
  const Estimates estimates = estimates_of(Evidence(asked), free);
  const int u = index_of(own_number(used));
  const double usual = law.numbers.front().usual;
  UnknownVector unit = UnknownVector::Zero();
  unit[u] = 1.0 / usual;
  return SizeOfLaw{usual * estimates.estimate[u], usual * estimates.deviation(u),
                   size_of(own, unit, asked.systems)};
}

/// A law that one of the two learnt: `verdict` where the other clearly has it not.
template <class D>
ComparedLaw compared(const Learnt& learnt, const FinalFit& other, const char* verdict, int threads,
                     const Watch& watch) {
  const LearntLawFound found = learnt_of(learnt);
  const bool in_real = std::string_view(verdict) == "lacks";
  ComparedLaw law;
  law.name = found.name;
  law.kind = "learnt";
  law.what = found.law;
  law.verdict = "cannot_tell";
  law.where.direction = found.acts;
  (in_real ? law.real : law.simulated) = found.numbers;
  const std::optional<SizeOfLaw> there = size_in<D>(other, learnt, threads, watch);
  if (!there) return law;
  const LawNumber& number = learnt.law.numbers.front();
  (in_real ? law.simulated : law.real)
      .push_back(with_deviation(number.name, there->value, there->deviation, number.unit));
  const double less = learnt.value.front() - there->value,
               deviation = std::hypot(learnt.deviation.front(), there->deviation);
  law.difference.push_back(with_deviation(number.name, in_real ? less : -less, deviation, number.unit));
  const double size = std::abs(less) * there->reach;
  const bool of_spin = learnt.law.acts == Acts::kSpin;
  if (std::abs(less) > kSignificance * deviation && size > (of_spin ? kSmallestSpinShare : kSmallestReach))
    law.verdict = verdict;
  if (!of_spin) law.size_m = size;
  return law;
}

/// Laws that were learnt, of reality first. What both learnt in the same form is told once.
template <class D>
std::vector<ComparedLaw> compared_learnt(const Diagnosis& real, const Diagnosis& simulated, int threads,
                                         const Watch& watch) {
  std::vector<ComparedLaw> result, others;
  for (const Learnt& learnt : real.learnt)
    result.push_back(compared<D>(learnt, *simulated.final_fit, "lacks", threads, watch));
  for (const Learnt& learnt : simulated.learnt) {
    const auto same = std::ranges::find_if(real.learnt, [&](const Learnt& other) {
      return other.law.acts == learnt.law.acts && other.law.formula.text() == learnt.law.formula.text();
    });
    if (same == real.learnt.end()) {
      others.push_back(compared<D>(learnt, *real.final_fit, "should_not_have", threads, watch));
      continue;
    }
    ComparedLaw& both = result[static_cast<std::size_t>(same - real.learnt.begin())];
    both.simulated = learnt_of(learnt).numbers;
    if (both.verdict == "cannot_tell") both.verdict = "agrees";
  }
  std::ranges::move(others, std::back_inserter(result));
  return result;
}

}  // namespace diagnose_detail

}  // namespace diabolo
