// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/adequacy_words.hpp"
#include "diabolo/diagnose/findings.hpp"
#include "diabolo/diagnose/own_laws.hpp"
#include "diabolo/diagnose/unnamed_structure.hpp"

namespace diabolo {

namespace diagnose_detail {

inline Estimate with_deviation(std::string name, double value, double deviation, std::string unit) {
  return {std::move(name), value, std::move(unit),
          Interval{value - kNormal95 * deviation, value + kNormal95 * deviation}};
}

/// Length of two numbers, with the deviation that theirs give it.
inline std::pair<double, double> length_of(double a, double b, double da, double db) {
  const double length = std::hypot(a, b);
  return {length, length > 0.0 ? std::hypot(a * da, b * db) / length : std::hypot(da, db)};
}

/// Those of a law of somebody's own.
inline std::vector<Estimate> own_numbers_of(const Finding& f) {
  std::vector<Unknown> unknowns = f.candidate->unknowns;
  unknowns.insert(unknowns.end(), f.candidate->companions.begin(), f.candidate->companions.end());
  std::vector<Estimate> result;
  for (const Unknown u : unknowns) {
    const OwnNumber own = own_number_of(*f.candidate, u);
    result.push_back(with_deviation(own.number->name, own.number->within(own.value(f.estimate[index_of(u)])),
                                    own.number->usual * f.deviation[index_of(u)], own.number->unit));
  }
  return result;
}

/// A learnt law as a result tells it.
inline LearntLawFound learnt_of(const Learnt& learnt) {
  LearntLawFound found;
  found.name = learnt.law.name;
  found.law = learnt_plainly(learnt);
  found.acts = names_of(Acts{})[static_cast<std::size_t>(learnt.law.acts)];
  found.formula = learnt.law.formula.text();
  for (std::size_t i = 0; i < learnt.value.size(); ++i)
    found.numbers.push_back(with_deviation(learnt.law.numbers[i].name, learnt.value[i], learnt.deviation[i],
                                           learnt.law.numbers[i].unit));
  found.gain = learnt.gain;
  if (learnt.dependence) {
    found.gain_by_strength = learnt.dependence->gain;
    found.gain_permuted = learnt.dependence->permuted;
    found.dependence_p_value = learnt.dependence->p_value;
  }
  found.worse_without_ci95_m = learnt.worsening_ci95;
  found.spin_worse_without_ci95_radps = learnt.spin_worsening_ci95;
  return found;
}

/// The parameters of a finding by their fixed names.
inline std::vector<Estimate> parameters_of(const Finding& f, double given_length, double given_gravity) {
  const auto value = [&](Unknown u) { return f.estimate[index_of(u)]; };
  const auto deviation = [&](Unknown u) { return f.deviation[index_of(u)]; };
  const auto plain = [&](std::string_view name, Unknown u, double offset = 0.0) {
    return with_deviation(std::string(name), offset + value(u), deviation(u), std::string(info_of(u).unit));
  };
  // What the data put below zero is none, as in the model.
  const auto damping = [&](Unknown u) {
    const auto at = [&](double deviations) { return std::max(0.0, value(u) + deviations * deviation(u)); };
    return Estimate{"damping", at(0.0), "N s/m", Interval{at(-kNormal95), at(kNormal95)}};
  };
  const auto stiffness = [&](Unknown u) {
    const auto of = [](double compliance) { return 1.0 / std::max(compliance, 1e-6); };
    const double c = value(u), spread = kNormal95 * deviation(u);
    return Estimate{"stiffness", of(c), "N/m", Interval{of(c + spread), of(c - spread)}};
  };
  using enum Unknown;
  if (f.swapped > 0) {
    const double frames = static_cast<double>(f.swapped);
    return {Estimate{"frames", frames, "1", Interval{frames, frames}}};
  }
  if (f.candidate->law != nullptr) return own_numbers_of(f);
  const Unknown first = first_of(*f.candidate);
  if (!f.candidate->number.empty()) return {plain(f.candidate->number, first)};
  switch (first) {
    case kCompliance:
      return {stiffness(kCompliance), damping(kDamping)};
    case kStickCompliance:
      return {stiffness(kStickCompliance), damping(kStickDamping)};
    case kWindX:
      return {plain("x", first), plain("y", f.candidate->unknowns.back())};
    case kGravity: {
      if (f.candidate->kind == CandidateKind::kPhysics) return {plain("g", kGravity, given_gravity)};
      // In the file's seconds gravity is as much stronger as the square of what the rate is too high by.
      const double factor = std::sqrt(std::max(1e-6, 1.0 + value(kGravity) / given_gravity));
      return {with_deviation("factor", factor, deviation(kGravity) / (2.0 * factor * given_gravity), "1")};
    }
    case kTiltX: {
      const auto [angle, spread] =
          length_of(value(kTiltX), value(kTiltY), deviation(kTiltX), deviation(kTiltY));
      const double direction = std::atan2(value(kTiltY), value(kTiltX));
      const double turn = spread / std::max(angle, 1e-9);
      return {with_deviation("angle_deg", std::asin(std::min(1.0, angle)) / kDegree, spread / kDegree, "deg"),
              with_deviation("azimuth_deg", direction / kDegree, std::min(180.0, turn / kDegree), "deg")};
    }
    case kLengthScale:
      return {plain("factor", kLengthScale, 1.0)};
    case kMarkerX: {
      const auto [radius, spread] =
          length_of(value(kMarkerY), value(kMarkerZ), deviation(kMarkerY), deviation(kMarkerZ));
      return {with_deviation("radius", radius, spread, "m"), plain("axial", kMarkerX)};
    }
    case kStringLength:
      return {plain("length", kStringLength, given_length)};
    default: {
      std::vector<Estimate> list;
      for (const Unknown u : f.candidate->unknowns) list.push_back(plain(info_of(u).name, u));
      return list;
    }
  }
}

}  // namespace diagnose_detail

}  // namespace diabolo
