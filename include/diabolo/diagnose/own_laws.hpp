// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/select.hpp"
#include "diabolo/effects/formula_laws.hpp"

namespace diabolo {

/// The base's laws and then those of somebody's own, which become candidates: the first number of each stands
/// for it. Throws std::invalid_argument where a name is taken, or there are too many numbers.
inline std::shared_ptr<const OwnCandidates> own_candidates(const FormulaLaws<double>& base,
                                                           const std::vector<Law>& own) {
  for (const Law& law : own)
    if (std::ranges::find(candidates(), law.name, &Candidate::name) != candidates().end())
      throw std::invalid_argument("law " + shown(law.name) + ": the name is taken by one of the library");
  std::vector<Law> laws = base.laws ? *base.laws : std::vector<Law>{};
  const std::size_t known = laws.size();
  laws.insert(laws.end(), own.begin(), own.end());
  auto result = std::make_shared<OwnCandidates>();
  result->laws = FormulaLaws<double>(std::move(laws));
  std::size_t index = 0;
  result->laws.each([&](const Law& law, std::size_t first) {
    if (index++ < known) {
      for (std::size_t i = 0; i < law.numbers.size(); ++i)
        result->laws.numbers[first + i] = base.numbers[first + i];
      return;
    }
    Candidate candidate{law.name, law.plain,     CandidateKind::kPhysics, {own_number(first)},
                        0.0,      law.positive()};
    for (std::size_t i = 1; i < law.numbers.size(); ++i)
      candidate.companions.push_back(own_number(first + i));
    candidate.by_spin = law.by_spin();
    candidate.law = &law;
    result->list.push_back(std::move(candidate));
  });
  return result;
}

/// A number of a law of somebody's own by its unknown, and how it reads: value = begin + usual * unknown.
struct OwnNumber {
  const LawNumber* number;
  double begin;

  double value(double unknown) const { return begin + number->usual * unknown; }
};
inline OwnNumber own_number_of(const Candidate& candidate, Unknown u) {
  const std::size_t i = static_cast<std::size_t>(index_of(u) - index_of(candidate.unknowns.front()));
  const LawNumber& number = candidate.law->numbers[i];
  return {&number, number.expected};
}

/// Notes what the numbers of learnt laws came out as; their laws are the model's last ones.
inline void note_learnt(Diagnosis& d, const Model& physics, const Fit& fit, const ActiveSet& set) {
  if (d.learnt.empty()) return;
  const Estimates now = estimates_of(Evidence(fit), set);
  const auto& own = physics.effects.get<FormulaLaws>();
  std::size_t index = 0;
  const std::size_t known = own.laws->size() - d.learnt.size();
  own.each([&](const Law& law, std::size_t first) {
    if (index++ < known) return;
    Learnt& learnt = d.learnt[index - known - 1];
    learnt.law = law;
    learnt.first = first;
    for (std::size_t i = 0; i < law.numbers.size(); ++i) {
      const int u = index_of(own_number(first + i));
      learnt.value.push_back(
          law.numbers[i].within(own.numbers[first + i] + law.numbers[i].usual * fit.at[u]));
      learnt.deviation.push_back(law.numbers[i].usual * now.deviation(u));
    }
  });
}

}  // namespace diabolo
