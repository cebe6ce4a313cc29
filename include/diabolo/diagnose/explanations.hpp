// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/fit.hpp"

namespace diabolo {

/// Explanations predict the same where the squares of what they leave differ by less than this share, beside
/// three standard deviations' worth: the model itself is no better.
inline constexpr double kSameResidual = 0.01;

namespace diagnose_detail {

/// A claim, or what it may be exchanged for.
struct Explanation {
  std::string_view name;
  Fit fit;
  ActiveSet set;
  std::ptrdiff_t explanations;  ///< that the fit is sure of
  bool sure;                    ///< else it may be there
  bool as_good = true;          ///< as any that is sure; set by keep_the_good()
  bool but_for_one = true;      ///< that, or would be but for a single window
};

/// By how much the window that most prefers `one` to `other` does, in cost.
inline double strongest_preference(const Fit& one, const Fit& other) {
  double most = 0.0;
  for (std::size_t i = 0; i < one.scores.size(); ++i)
    most = std::max(most, other.scores[i].cost - one.scores[i].cost);
  return most;
}

/// Adds an explanation; of two of a name, the one that leaves less stays.
inline void add(std::vector<Explanation>& options, Explanation option) {
  const auto same = std::ranges::find(options, option.name, &Explanation::name);
  if (same == options.end())
    options.push_back(std::move(option));
  else if (option.fit.cost < same->fit.cost)
    *same = std::move(option);
}

/// Leaves those that explain a claim as well as the best that is sure, and those that would but for a single
/// window: a catch that one of them mistimes decides nothing.
inline void keep_the_good(std::vector<Explanation>& options, std::string_view claim) {
  const auto order = [](const Explanation& option) { return std::tuple(!option.sure, option.fit.cost); };
  const Fit& best = std::ranges::min_element(options, {}, order)->fit;
  // What the model does not describe is the same whether the string is wrapped or not.
  const double imprecision = claim == "string_friction" ? 0.0 : kSameResidual;
  const double worse = kAsGood * best.dispersion + imprecision * best.cost;
  for (Explanation& option : options) {
    const double more = option.fit.cost - best.cost;
    option.as_good = more < worse;
    option.but_for_one = more - strongest_preference(best, option.fit) < worse;
  }
  std::erase_if(options, [](const Explanation& option) { return !option.but_for_one; });
}

/// See exchange_claims().
inline Explanation best_of(const std::vector<Explanation>& options, const Candidate& claim) {
  const bool fault = claim.kind == CandidateKind::kMeasurement;
  return std::ranges::min(options, {}, [&](const Explanation& option) {
    const bool rarer = fault || option.fit.at[index_of(Unknown::kWraps)] > 0.0;
    return std::tuple(!option.sure, !option.as_good, option.explanations, rarer && option.name != claim.name,
                      option.fit.cost);
  });
}

}  // namespace diagnose_detail

}  // namespace diabolo
