// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "diabolo/diagnose/fit.hpp"
#include "diabolo/diagnose/unknowns.hpp"

namespace diabolo {

enum class CandidateKind { kPhysics, kMeasurement };

/// Something that may be missing, under the name that a result gives it, with the unknowns that it is made
/// of.
struct Candidate {
  std::string_view name, plain;
  CandidateKind kind;
  std::vector<Unknown> unknowns;
  double floor;   ///< claimed only beyond, in any of its unknowns; of physics see kSmallestReach
  bool positive;  ///< a negative amplitude is against physics
};

/// Physics is claimed only where it moves the diabolo by so much within half a second, in the most affected
/// tenth of the windows [m]; the spin by this share within a second.
inline constexpr double kSmallestReach = 1e-3, kSmallestSpinShare = 0.05;

inline const std::vector<Candidate>& candidates() {
  using enum Unknown;
  using enum CandidateKind;
  static const std::vector<Candidate> all{
      {"string_elasticity", "the string's stretch", kPhysics, {kCompliance}, 0.0, true},
      {"string_friction", "friction of the string on the axle", kPhysics, {kFriction}, 0.0, true},
      {"air_drag_linear", "a drag that grows with speed", kPhysics, {kLinearDrag}, 0.0, true},
      {"air_drag_quadratic", "the drag of the air", kPhysics, {kQuadraticDrag}, 0.0, true},
      {"magnus_lift", "the lift of the spinning diabolo (Magnus)", kPhysics, {kLift}, 0.0, false},
      {"spin_drag", "the air that slows the spin", kPhysics, {kSpinAir}, 0.0, true},
      {"axle_drag", "a bearing that slows the spin", kPhysics, {kSpinAxle}, 0.0, true},
      {"gravity_tilt", "a tilted frame", kMeasurement, {kTiltX, kTiltY}, 0.3 * kDegree, false},
      {"length_scale", "the scale of lengths", kMeasurement, {kLengthScale}, 0.003, false},
      {"time_offset", "a delay between diabolo and sticks", kMeasurement, {kTimeOffset}, 0.002, false},
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
  };
  return all;
}

/// Free in every fit: what no recording is without.
inline ActiveSet nuisances() {
  ActiveSet set = ActiveSet::Constant(false);
  for (int u = index_of(Unknown::kTiltX); u <= index_of(Unknown::kAxleRadius); ++u) set[u] = true;
  return set;
}

/// `set` with, or without, a candidate's unknowns; the string's damping goes with its compliance.
inline ActiveSet with(ActiveSet set, const Candidate& candidate, bool included = true) {
  for (const Unknown u : candidate.unknowns) set[index_of(u)] = included;
  if (candidate.unknowns.front() == Unknown::kCompliance) set[index_of(Unknown::kDamping)] = included;
  return set;
}

inline bool is_in(const ActiveSet& set, const Candidate& candidate) {
  return set[index_of(candidate.unknowns.front())];
}

inline bool is_of_spin(const Candidate& candidate) {
  return candidate.unknowns.front() == Unknown::kSpinAir || candidate.unknowns.front() == Unknown::kSpinAxle;
}

/// How far unknowns like these move the diabolo within half a second in the most affected tenth of the
/// windows [m]; of spin effects the share of the spin that goes within a second.
inline double size_of(const Candidate& candidate, const UnknownVector& at,
                      const std::vector<WindowSystem>& systems) {
  std::vector<double> sizes;
  for (const WindowSystem& system : systems) {
    if (system.failed) continue;
    double size = 0.0;
    for (const Unknown u : candidate.unknowns) {
      const double amplitude = std::abs(at[index_of(u)] / info_of(u).scale);
      size += is_of_spin(candidate)
                  ? 2.0 * amplitude * system.spin_reach[index_of(u)] / std::max(10.0, system.spin)
                  : amplitude * system.reach[index_of(u)];
    }
    sizes.push_back(size);
  }
  if (sizes.empty()) return 0.0;
  std::ranges::sort(sizes);
  return quantile(sizes, 0.9);
}

}  // namespace diabolo
