// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/fit.hpp"
#include "diabolo/diagnose/unknowns.hpp"

namespace diabolo {

/// Physics is claimed only where it moves the diabolo by so much within half a second, in the most affected
/// tenth of the windows [m]; the spin by this share within this time [s].
inline constexpr double kSmallestReach = 1e-3, kSmallestSpinShare = 0.05, kSpinTime = 10.0;

inline const std::vector<Candidate>& candidates() {
  using enum Unknown;
  using enum CandidateKind;
  static const std::vector<Candidate> all{
      {"string_elasticity", "the string's stretch", kPhysics, {kCompliance}, 0.0, true, {kDamping}},
      {"stick_flex",
       "the bending of the sticks",
       kPhysics,
       {kStickCompliance},
       0.0,
       true,
       {kStickDamping, kTipMass}},
      {"string_friction",
       "friction of the string on the axle",
       kPhysics,
       {kFriction},
       0.0,
       true,
       {kSpinGain}},
      {"string_wrap", "a string that is wrapped around the axle", kPhysics, {kWraps}, 0.0, true},
      {"landing_restitution", "the bounce of a catch", kPhysics, {kRestitution}, 0.0, true},
      {"air_drag_linear", "a drag that grows with speed", kPhysics, {kLinearDrag}, 0.0, true},
      {"air_drag_quadratic", "the drag of the air", kPhysics, {kQuadraticDrag}, 0.0, true},
      {"wind", "wind", kPhysics, {kWindX, kWindY}, 0.0, false},
      {"magnus_lift", "the lift of the spinning diabolo (Magnus)", kPhysics, {kLift}, 0.0, false},
      {"gyroscopic_tilt", "the tilt of the axle by the string", kPhysics, {kGyroscopicGain}, 0.0, true},
      {"string_mass", "the weight of the loose string", kPhysics, {kStringMass}, 0.0, true},
      {"spin_drag", "the air that slows the spin", kPhysics, {kSpinAir}, 0.0, true},
      {"axle_drag", "a bearing that slows the spin", kPhysics, {kSpinAxle}, 0.0, true},
      {"spin_coupling",
       "the string's drive of the spin",
       kPhysics,
       {kSpinCoupling, kSpinGain},  // by the base's rule, or by friction's torque
       0.0,
       true},
      {"gravity_magnitude", "the strength of gravity", kPhysics, {kGravity}, 0.05 * kStandardGravity, false},
      {"frame_rate", "the rate of the frames", kMeasurement, {kGravity}, 0.01 * kStandardGravity, false},
      {"placebo_drag", "a drag along one axis of the recording", kPhysics, {kPlacebo}, 0.0, true},
      {"placebo_push",
       "a push along the string that never changes its sign",
       kPhysics,
       {kStringTangent},
       0.0,
       false},
      {"gravity_tilt", "a tilted frame", kMeasurement, {kTiltX, kTiltY}, 0.3 * kDegree, false},
      {"length_scale", "the scale of lengths", kMeasurement, {kLengthScale}, 0.003, false},
      {"time_offset", "a delay between diabolo and sticks", kMeasurement, {kTimeOffset}, 0.002, false},
      {"filter_lag", "a low pass that delays the diabolo", kMeasurement, {kLag}, 0.002, true},
      {"robot_servo_lag", "sticks that lag behind the recorded ones", kMeasurement, {kLag}, 0.002, true},
      {"marker_offset",
       "the diabolo's recorded centre",
       kMeasurement,
       {kMarkerX, kMarkerY, kMarkerZ},
       0.0005,
       false},
      {"stick_tip_offset",
       "the places of the stick tips",
       kMeasurement,
       {kLeftX, kLeftY, kLeftZ, kRightX, kRightY, kRightZ},
       0.002,
       false},
      {"string_length", "the string's length", kMeasurement, {kStringLength}, 0.004, false},
      {"body_swap", "bodies under each other's names", kMeasurement, {}, 0.0, false},
  };
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
    if (first_of(candidate) == Unknown::kGyroscopicGain) continue;  // see find_axle_motion()
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

/// `set` with, or without, a candidate's unknowns and those that count only beside them.
inline ActiveSet with(ActiveSet set, const Candidate& candidate, bool included = true) {
  for (const Unknown u : candidate.unknowns) set[index_of(u)] = included;
  for (const Unknown u : candidate.companions) set[index_of(u)] = included;
  return set;
}

inline bool is_in(const ActiveSet& set, const Candidate& candidate) {
  return set[index_of(first_of(candidate))];
}

inline bool is_of_spin(const Candidate& candidate) {
  const Unknown first = first_of(candidate);
  if (candidate.law != nullptr) return candidate.law->acts == Acts::kSpin;
  return first == Unknown::kSpinAir || first == Unknown::kSpinAxle || first == Unknown::kSpinCoupling;
}

/// How far unknowns like these move the diabolo within half a second in the most affected tenth of the
/// windows [m]; of spin effects the share of the spin that goes within kSpinTime.
inline double size_of(const Candidate& candidate, const UnknownVector& at,
                      const std::vector<WindowSystem>& systems) {
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
