// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "diabolo/diagnose/adequacy_words.hpp"
#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/finding_parameters.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// As many digits as its interval leaves sense in, and one more.
inline std::string within_interval(const Estimate& estimate) {
  const double half = estimate.ci90 ? 0.5 * (estimate.ci90->high - estimate.ci90->low) : 0.0;
  if (!(half > 0.0 && std::isfinite(half))) return three_digits(estimate.value);
  const double tens = std::pow(10.0, std::max(0.0, 1.0 - std::floor(std::log10(half))));
  return shown(std::round(estimate.value * tens) / tens + 0.0);
}

/// "0.104 in one.csv, 0.412 in two.csv": the least and the most of a number, where it is one.
inline std::string values_in_words(const Differing& differing, const Diagnosis& d) {
  std::vector<Estimate> values;
  for (const FittedAlone& alone : differing.alone) {
    Finding f;
    f.candidate = differing.candidate;
    f.estimate = alone.estimate;
    f.deviation = alone.deviation;
    const std::vector<Estimate> all = diagnose_detail::parameters_of(f, d.base_string_length, d.base_gravity);
    if (differing.candidate->unknowns.size() > 1) return "";
    values.push_back(all.front());
  }
  const auto [least, most] = std::ranges::minmax_element(values, {}, &Estimate::value);
  std::string text;
  for (const auto& value : {least, most})
    text += (text.empty() ? ": " : ", ") + within_interval(*value) + unit_behind(value->unit) + " in " +
            differing.alone[static_cast<std::size_t>(value - values.begin())].recording;
  return text;
}

/// What recordings ask for different values of: sentences after the answer's.
inline std::string differing_in_words(const Diagnosis& d) {
  if (d.differing.empty()) return "";
  std::string text = " The recordings do not agree on ";
  for (std::size_t i = 0; i < d.differing.size(); ++i)
    text += (i == 0 ? "" : "; or on ") + std::string(d.differing[i].candidate->plain) +
            values_in_words(d.differing[i], d);
  return text + ". Diagnose them one by one.";
}

}  // namespace diabolo
