// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/fit.hpp"
#include "diabolo/diagnose/unknowns.hpp"

namespace diabolo {

/// Physics is claimed only where it moves the diabolo by so much within half a second, in the most affected
/// tenth of the windows [m]; the spin by this share within this time [s].
inline constexpr double kSmallestReach = 1e-3, kSmallestSpinShare = 0.05, kSpinTime = 10.0;

/// A law of the axle is claimed only where it turns it by so much in a second, in the most affected tenth of
/// the stretches [rad].
inline constexpr double kSmallestTurn = 3.0 * kDegree;

namespace diagnose_detail {

inline Candidate candidate_for(const NamedLaw& law) {
  Candidate candidate{.name = law.name,
                      .plain = law.plain,
                      .kind = CandidateKind::kPhysics,
                      .unknowns = {},
                      .positive = law.positive,
                      .direction = law.direction,
                      .number = law.number,
                      .by_spin = law.by_spin};
  for (const std::string_view field : law.amplitudes)
    if (!field.empty()) candidate.unknowns.push_back(unknown_named(field));
  for (const std::string_view field : law.companions)
    if (!field.empty()) candidate.companions.push_back(unknown_named(field));
  return candidate;
}

/// Physics that is no field of one effect, and what is there to be asked about and not to win.
inline std::vector<Candidate> other_physics() {
  using enum Unknown;
  using enum CandidateKind;
  return {{.name = "string_wrap",
           .plain = "a string that is wrapped around the axle",
           .kind = kPhysics,
           .unknowns = {kWraps},
           .positive = true,
           .direction = "string_tangent",
           .number = "turns"},
          {.name = "spin_coupling",
           .plain = "the string's drive of the spin",
           .kind = kPhysics,
           .unknowns = {kSpinCoupling, kSpinGain},  // by the base's rule, or by friction's torque
           .positive = true,
           .direction = "spin",
           .number = "coefficient",
           .by_spin = true},
          {.name = "gravity_magnitude",
           .plain = "the strength of gravity",
           .kind = kPhysics,
           .unknowns = {kGravity},
           .floor = 0.05 * kStandardGravity,
           .direction = "vertical"},
          {.name = "placebo_drag",
           .plain = "a drag along one axis of the recording",
           .kind = kPhysics,
           .unknowns = {kPlacebo},
           .positive = true,
           .direction = "horizontal",
           .number = "rate"},
          {.name = "placebo_push",
           .plain = "a push along the string that never changes its sign",
           .kind = kPhysics,
           .unknowns = {kStringTangent},
           .direction = "string_tangent",
           .number = "acceleration"}};
}

inline std::vector<Candidate> faults() {
  using enum Unknown;
  const auto fault = [](std::string_view name, std::string_view plain, std::vector<Unknown> unknowns,
                        double floor, std::string_view number = {}, bool positive = false) {
    return Candidate{.name = name,
                     .plain = plain,
                     .kind = CandidateKind::kMeasurement,
                     .unknowns = std::move(unknowns),
                     .floor = floor,
                     .positive = positive,
                     .number = number};
  };
  return {
      fault("frame_rate", "the rate of the frames", {kGravity}, 0.01 * kStandardGravity),
      fault("gravity_tilt", "a tilted frame", {kTiltX, kTiltY}, 0.3 * kDegree),
      fault("length_scale", "the scale of lengths", {kLengthScale}, 0.003),
      fault("time_offset", "a delay between diabolo and sticks", {kTimeOffset}, 0.002, "seconds"),
      fault("filter_lag", "a low pass that delays the diabolo", {kLag}, 0.002, "seconds", true),
      fault("robot_servo_lag", "sticks that lag behind the recorded ones", {kLag}, 0.002, "seconds", true),
      fault("marker_offset", "the diabolo's recorded centre", {kMarkerX, kMarkerY, kMarkerZ}, 0.0005),
      fault("stick_tip_offset", "the places of the stick tips",
            {kLeftX, kLeftY, kLeftZ, kRightX, kRightY, kRightZ}, 0.002),
      fault("string_length", "the string's length", {kStringLength}, 0.004),
      fault("body_swap", "bodies under each other's names", {}, 0.0),
  };
}

}  // namespace diagnose_detail

/// Laws as their effects list them, other physics, and faults of the measurement.
inline const std::vector<Candidate>& candidates() {
  static const std::vector<Candidate> all = [] {
    std::vector<Candidate> list;
    for (const NamedLaw& law : diagnose_detail::named_laws())
      list.push_back(diagnose_detail::candidate_for(law));
    std::ranges::move(diagnose_detail::other_physics(), std::back_inserter(list));
    std::ranges::move(diagnose_detail::faults(), std::back_inserter(list));
    return list;
  }();
  return all;
}

/// Free in every fit: what no recording is without.
inline bool is_nuisance(Unknown u) { return index_of(u) <= index_of(Unknown::kAxleRadius); }
inline Unknown first_of(const Candidate& candidate) {
  return candidate.unknowns.empty() ? Unknown::kCount : candidate.unknowns.front();
}
inline bool is_nuisance(const Candidate& candidate) { return is_nuisance(first_of(candidate)); }
inline ActiveSet nuisances() {
  ActiveSet set = ActiveSet::Constant(false);
  for (int u = 0; u < kUnknowns; ++u) set[u] = is_nuisance(static_cast<Unknown>(u));
  return set;
}

/// Of a form that no law has: asked about by name alone, to see that it does not win.
inline bool is_placebo(const Candidate& candidate) { return candidate.name.starts_with("placebo"); }

/// Physics that there may be.
inline bool is_law(const Candidate& candidate) {
  return candidate.kind == CandidateKind::kPhysics && !is_placebo(candidate);
}

/// The candidates that a diagnosis chooses from.
using Bank = std::vector<const Candidate*>;

inline const Candidate& candidate_of(std::string_view name) {
  return *std::ranges::find(candidates(), name, &Candidate::name);
}

/// What this one is looked for in place of (see exchange_claims()); empty for most.
inline std::string_view alternative_to(std::string_view name) {
  if (name == "filter_lag" || name == "robot_servo_lag") return "time_offset";
  if (name == "string_wrap") return "string_friction";
  return name == "frame_rate" ? "length_scale" : "";
}

/// Seen in the axle's direction alone, see AxleInquiry.
inline bool is_of_axle(const Candidate& candidate) { return candidate.direction == "axle"; }

/// All of them but placebos, or those of some names, as far as they can be missing in a base: a base that has
/// a spin coupling leaves it to be fitted, and one with the Earth's gravity has it right. In another one
/// gravity is asked about, and not the scale of lengths, which acts alike and is the better known. What is an
/// alternative to another fault comes in by exchange_claims(). Candidates of one's own are asked about with
/// the others. Throws std::invalid_argument about a name that is none.
inline Bank bank_for(const Parameters<double>& base, const std::vector<std::string>& names,
                     const std::vector<Candidate>& own = {}) {
  Bank bank;
  const auto wanted = [&](const Candidate& candidate) {
    return (names.empty() && !is_placebo(candidate)) ||
           std::ranges::any_of(names, [&](const std::string& name) {
             return name == candidate.name || alternative_to(name) == candidate.name;
           });
  };
  const bool earth = std::abs(base.gravity / kStandardGravity - 1.0) < 0.01;
  const bool asks_gravity = !earth && wanted(candidate_of("gravity_magnitude"));
  for (const Candidate& candidate : candidates()) {
    if (candidate.unknowns.empty() || !alternative_to(candidate.name).empty() || !wanted(candidate)) continue;
    if (is_of_axle(candidate)) continue;  // see axle_bank()
    if (candidate.name == "spin_coupling" && base.spin_coupling > 0.0) continue;
    if (candidate.name == "gravity_magnitude" && earth) continue;
    if (candidate.name == "length_scale" && asks_gravity) continue;
    bank.push_back(&candidate);
  }
  for (const Candidate& candidate : own)
    if (wanted(candidate)) bank.push_back(&candidate);
  for (const std::string& name : names)
    if (std::ranges::find(candidates(), name, &Candidate::name) == candidates().end() &&
        std::ranges::find(own, name, &Candidate::name) == own.end()) {
      std::string known;
      for (const Candidate& candidate : candidates())
        known.append(known.empty() ? "" : ", ").append(candidate.name);
      for (const Candidate& candidate : own) known.append(", ").append(candidate.name);
      throw std::invalid_argument(std::string("bank: \"").append(name).append("\"; expected of ") + known);
    }
  return bank;
}

/// The laws of the axle, all or those of some names; with the gain, without which none of them acts.
inline Bank axle_bank(const std::vector<std::string>& names) {
  const auto named = [&](const Candidate& candidate) {
    return is_of_axle(candidate) && (names.empty() || std::ranges::count(names, candidate.name) > 0);
  };
  Bank bank;
  if (std::ranges::none_of(candidates(), named)) return bank;
  for (const Candidate& candidate : candidates())
    if (named(candidate) || first_of(candidate) == Unknown::kGyroscopicGain) bank.push_back(&candidate);
  return bank;
}

/// `set` with, or without, a candidate's unknowns and those that count only beside them.
inline ActiveSet with(ActiveSet set, const Candidate& candidate, bool included = true) {
  for (const Unknown u : candidate.unknowns) set[index_of(u)] = included;
  for (const Unknown u : candidate.companions) set[index_of(u)] = included;
  return set;
}

/// `set` with one candidate in place of another, whose unknowns stay free where every fit has them.
inline ActiveSet in_place_of(const Candidate& old, const Candidate& young, const ActiveSet& set) {
  return with(is_nuisance(old) ? set : with(set, old, false), young);
}

inline bool is_in(const ActiveSet& set, const Candidate& candidate) {
  return set[index_of(first_of(candidate))];
}

inline bool is_of_spin(const Candidate& candidate) {
  return candidate.law != nullptr ? candidate.law->acts == Acts::kSpin : candidate.direction == "spin";
}

/// How far unknowns like these move the diabolo within half a second in the most affected tenth of the
/// windows [m]; of spin effects the share of the spin that goes within kSpinTime.
inline double size_of(const Candidate& candidate, const UnknownVector& at,
                      std::span<const WindowSystem> systems) {
  std::vector<double> sizes;
  for (const WindowSystem& system : systems) {
    if (system.failed) continue;
    double size = 0.0;
    for (const Unknown u : candidate.unknowns) {
      const double amplitude = std::abs(at[index_of(u)] / info_of(u).scale);
      size += is_of_spin(candidate)
                  ? 2.0 * kSpinTime * amplitude * system.spin_reach[index_of(u)] / std::max(10.0, system.spin)
                  : amplitude * system.reach[index_of(u)];
    }
    sizes.push_back(size);
  }
  if (sizes.empty()) return 0.0;
  std::ranges::sort(sizes);
  return quantile(sizes, 0.9);
}

}  // namespace diabolo
