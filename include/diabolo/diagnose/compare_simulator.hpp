// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/diagnose/compare_axle.hpp"
#include "diabolo/diagnose/compare_learnt.hpp"
#include "diabolo/diagnose/conclude.hpp"
#include "diabolo/diagnose/differing.hpp"
#include "diabolo/diagnose/final_fit.hpp"
#include "diabolo/diagnose/result_of.hpp"
#include "diabolo/diagnose/select.hpp"
#include "diabolo/diagnose/simulator_comparison.hpp"

// A simulator is a black box that left a motion behind. It is diagnosed as reality is, against the same base,
// and what the two were found to have is held side by side.
namespace diabolo {

namespace diagnose_detail {

/// A claim by its name; null where there is none.
inline const Finding* claim_of(const Diagnosis& d, std::string_view name) {
  const auto found = std::ranges::find_if(
      d.findings, [&](const Finding& f) { return f.claimed && f.candidate->name == name; });
  return found == d.findings.end() ? nullptr : &*found;
}

/// What is claimed of either, of the first in its order; less what turns the axle where one cannot tell.
inline std::vector<const Candidate*> claimed_of_either(const Diagnosis& real, const Diagnosis& simulated) {
  std::vector<const Candidate*> result;
  for (const Diagnosis* d : {&real, &simulated})
    for (const Finding& f : d->findings)
      if (f.claimed && f.swapped == 0 && (!is_of_axle(*f.candidate) || both_tell_axle(real, simulated)) &&
          (d == &real || claim_of(real, f.candidate->name) == nullptr))
        result.push_back(f.candidate);
  return result;
}

/// The estimates where what is claimed of either is free in both: like is held beside like.
inline Estimates estimates_beside(const FinalFit& final_fit, const std::vector<const Candidate*>& claimed) {
  ActiveSet free = final_fit.free;
  for (const Candidate* candidate : claimed)
    if (candidate->kind == CandidateKind::kPhysics && first_of(*candidate) != Unknown::kWraps &&
        !is_of_axle(*candidate))  // which are fitted apart
      free = with(free, *candidate);
  Estimates result = estimates_of(Evidence(final_fit.fit), free);
  for (const Unknown tried : kTriedUnknowns)
    result.estimate[index_of(tried)] = final_fit.fit.at[index_of(tried)];
  result.estimate[index_of(Unknown::kLag)] = final_fit.fit.at[index_of(Unknown::kLag)];
  return result;
}

inline Finding finding_of(const Candidate& candidate, const Estimates& estimates) {
  Finding f;
  f.candidate = &candidate;
  f.estimate = estimates.estimate;
  for (int u = 0; u < kUnknowns; ++u) f.deviation[u] = estimates.deviation(u);
  return f;
}

/// Whether everybody has more or less of it, and never none.
inline bool has_always(const Candidate& candidate) {
  return first_of(candidate) == Unknown::kStringLength || candidate.name == "gravity_magnitude";
}

/// What the simulator has of it, where the two differ.
inline const char* verdict_of(const Candidate& candidate, const Estimates& real, const Estimates& simulated,
                              bool is_real, bool is_simulated, bool always) {
  const auto length = [&](const Estimates& estimates) {
    double square = 0.0;
    for (const Unknown u : candidate.unknowns)
      square += std::pow(estimates.estimate[index_of(u)] / info_of(u).scale, 2);
    return candidate.unknowns.size() == 1 ? estimates.estimate[index_of(first_of(candidate))]
                                          : std::sqrt(square);
  };
  if (is_real && !is_simulated && !always) return "lacks";
  if (!is_real && is_simulated && !always) return "should_not_have";
  const double a = length(real), b = length(simulated);
  return (candidate.positive || always || a * b < 0.0 ? b > a : std::abs(b) > std::abs(a)) ? "too_much"
                                                                                           : "too_little";
}

/// Real less simulated, number by number. Of springs it is what has to stand in series: their compliances
/// add.
inline std::vector<Estimate> difference_of(const Candidate& candidate, const Estimates& difference,
                                           const std::vector<Estimate>& real,
                                           const std::vector<Estimate>& simulated) {
  if (first_of(candidate) == Unknown::kCompliance || first_of(candidate) == Unknown::kStickCompliance)
    return parameters_of(finding_of(candidate, difference), 0.0, 1.0);
  std::vector<Estimate> result;
  for (std::size_t i = 0; i < std::min(real.size(), simulated.size()); ++i) {
    const auto deviation = [](const Estimate& e) {
      return e.ci90 ? (e.ci90->high - e.ci90->low) / (2.0 * kNormal95) : 0.0;
    };
    result.push_back(with_deviation(real[i].name, real[i].value - simulated[i].value,
                                    std::hypot(deviation(real[i]), deviation(simulated[i])), real[i].unit));
  }
  return result;
}

inline ComparedLaw compared(const Candidate& candidate, const Diagnosis& real, const Diagnosis& simulated,
                            const Estimates& in_real, const Estimates& in_simulated) {
  const Estimates difference = less(in_real, in_simulated);
  const Finding *const claim = claim_of(real, candidate.name), *const same =
                                                                   claim_of(simulated, candidate.name);
  const bool of_axle = is_of_axle(candidate);
  const double size = of_axle ? turn_of(claim != nullptr ? *claim : *same, difference)
                              : size_of(candidate, difference.estimate, real.final_fit->fit.systems);
  const bool always = has_always(candidate) || base_turns_axle_by(candidate, real);
  ComparedLaw law;
  law.name = candidate.name;
  law.kind = kind_of(candidate);
  law.what = candidate.plain;
  const bool in_one = claim == nullptr || same == nullptr;
  law.verdict = differs(candidate, difference, size)
                    ? verdict_of(candidate, in_real, in_simulated, claim != nullptr, same != nullptr, always)
                : in_one ? "cannot_tell"
                         : "agrees";
  law.tied_with = (claim != nullptr ? claim : same)->tied_with;
  law.p_value = family_wise(significance(candidate, difference));
  law.real = parameters_of(finding_of(candidate, in_real), real.base_string_length, real.base_gravity);
  law.simulated = parameters_of(finding_of(candidate, in_simulated), simulated.base_string_length,
                                simulated.base_gravity);
  law.difference = difference_of(candidate, difference, law.real, law.simulated);
  law.where = claim != nullptr ? place_of(*claim, real.windows) : place_of(*same, simulated.windows);
  if (of_axle) law.axle_1s_rad = size;
  if (!is_of_spin(candidate) && !of_axle && candidate.kind == CandidateKind::kPhysics) law.size_m = size;
  return law;
}

/// Names of some verdict in a row: "a, b and c"; of faults of measurement or of all else.
inline std::string listed(const std::vector<ComparedLaw>& laws, const Diagnosis& real,
                          std::string_view verdict, bool faults = false) {
  std::vector<std::string> names;
  for (const ComparedLaw& law : laws) {
    const bool fault = law.kind == "measurement" && law.verdict == "should_not_have";
    if (law.verdict != verdict || fault != faults) continue;
    names.push_back(law.what);
    for (std::size_t i = 0; i < law.tied_with.size(); ++i)
      names.back() += (i == 0 ? " (or " : ", ") + plainly(real, law.tied_with[i]) +
                      (i + 1 == law.tied_with.size() ? ")" : "");
  }
  return diabolo::listed(names);
}

/// Whether something without a name is left that `camera`'s noise would not hide: a simulator has none of its
/// own, and not every micrometre of it counts.
inline bool has_left_over(const Diagnosis& d, const Diagnosis& camera) {
  if (d.adequacy.adequate.value_or(true)) return false;
  return std::ranges::any_of(d.adequacy.overall, [&](const ResidualAndNoise& left) {
    if (!(left.times_noise > kTimesNoise)) return false;
    const auto same = std::ranges::find_if(camera.adequacy.overall, [&](const ResidualAndNoise& other) {
      return other.quantity == left.quantity && other.ahead_s == left.ahead_s;
    });
    return same == camera.adequacy.overall.end() || left.left > kTimesNoise * same->noise;
  });
}

inline std::string sentence_of(const SimulatorComparison& c, const Diagnosis& real,
                               const Diagnosis& simulated) {
  if (!real.reason.empty()) return "Nothing can be compared: of the recordings, " + real.reason + ".";
  if (!simulated.reason.empty())
    return "Nothing can be compared: of what was simulated, " + simulated.reason + ".";
  std::string text;
  const auto say = [&](const char* verdict, const std::string& before, const std::string& after) {
    const std::string names = listed(c.laws, real, verdict);
    if (!names.empty()) text += (text.empty() ? "The simulator " : "; it ") + before + names + after;
  };
  say("lacks", "lacks ", "");
  say("too_little", "has too little of ", "");
  say("too_much", "has too much of ", "");
  say("should_not_have", "has ", ", which reality has not");
  if (const std::string faults = listed(c.laws, real, "should_not_have", true); !faults.empty())
    text += (text.empty() ? "The simulator" : "; it") + (" plays as with a fault of " + faults);
  text =
      text.empty() ? "The simulator has what reality has, as far as these recordings can show." : text + ".";
  if (const std::string both = listed(c.laws, real, "agrees"); !both.empty())
    text += " Reality and the simulator agree in " + both + ".";
  if (const std::string open = listed(c.laws, real, "cannot_tell"); !open.empty())
    text += " Whether the two agree in " + open + " cannot be told.";
  if (!c.recording_faults.empty()) {
    text += " The recordings are off by ";
    for (std::size_t i = 0; i < c.recording_faults.size(); ++i)
      text += (i == 0 ? "" : " and ") + c.recording_faults[i];
    text += ".";
  }
  const bool real_left = has_left_over(real, real), simulated_left = has_left_over(simulated, real);
  if (real_left || simulated_left)
    text += std::string(" Something without a name is left in ") +
            (real_left && simulated_left ? "both"
             : real_left                 ? "reality"
                                         : "the simulator") +
            ".";
  return text + axle_not_compared(real, simulated);
}

}  // namespace diagnose_detail

/// Holds what reality was found to have beside what a simulator was found to have, both against the same
/// base. `real_result` and `simulated_result` are what result_of() makes of them.
template <class D = diagnose_detail::FitDual>
SimulatorComparison compare_simulator(const Diagnosis& real, const Diagnosis& simulated,
                                      DiagnosisResult real_result, DiagnosisResult simulated_result,
                                      int threads, const Watch& watch = {}) {
  namespace in = diagnose_detail;
  SimulatorComparison result;
  result.real = std::move(real_result);
  result.simulated = std::move(simulated_result);
  if (real.final_fit && simulated.final_fit) {
    const std::vector<const Candidate*> claimed = in::claimed_of_either(real, simulated);
    const Estimates in_real = in::estimates_beside(*real.final_fit, claimed),
                    in_simulated = in::estimates_beside(*simulated.final_fit, claimed);
    for (const Candidate* candidate : claimed) {
      ComparedLaw law = is_of_axle(*candidate)
                            ? in::compared(*candidate, real, simulated, in::axle_estimate(real, *candidate),
                                           in::axle_estimate(simulated, *candidate))
                            : in::compared(*candidate, real, simulated, in_real, in_simulated);
      const bool in_real_alone = in::claim_of(simulated, candidate->name) == nullptr;
      if (law.kind == "measurement" && in_real_alone && !in::has_always(*candidate))
        result.recording_faults.push_back(plainly(real, {in::claim_of(real, candidate->name)}));
      else
        result.laws.push_back(std::move(law));
    }
    std::ranges::move(in::compared_learnt<D>(real, simulated, threads, watch),
                      std::back_inserter(result.laws));
    const auto is_open = [](const ComparedLaw& law) {
      return law.verdict == "agrees" || law.verdict == "cannot_tell";
    };
    std::ranges::stable_sort(result.laws, [&](const ComparedLaw& a, const ComparedLaw& b) {
      return is_open(a) != is_open(b) ? is_open(b) : a.size_m.value_or(0.0) > b.size_m.value_or(0.0);
    });
  }
  result.sentence = in::sentence_of(result, real, simulated);
  return result;
}

}  // namespace diabolo
