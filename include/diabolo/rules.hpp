// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

#include "diabolo/math/scalar.hpp"

namespace diabolo {

/// How the string acts on the diabolo.
enum class StringLaw {
  kPullVelocity,  ///< the paper's: put back on the spheroid, a capped part of the correction becomes velocity
  kInextensible,  ///< a massless string that does not stretch: velocity consistent with the constraint
};
/// Where a diabolo outside the spheroid is put back.
enum class Projection { kRadial, kClosestPoint };
/// Which direction counts as the spheroid's normal.
enum class NormalRule { kPublished, kTrue };
/// When the diabolo leaves the string and comes back to it.
enum class FlightRule {
  kPublished,  ///< the authors' program: above the plane of the tips and between them
  kPaper,      ///< the paper's c_L and c_F on the signed distance
  kSlack,      ///< ours: as the paper, on the slack of the string, and caught inside the spheroid only
};
/// What happens to the pull when the spheroid is thin.
enum class ThinRule {
  kPublished,  ///< loses its component along (left - right) x z and keeps its magnitude
  kPaper,      ///< acts along x cross (left - right) only
};
/// How passing string drives the spin.
enum class SpinRule {
  kSlip,          ///< in proportion to the slip between string and axle
  kLengthChange,  ///< the paper's mu times the change of the distance to the right tip
};
enum class Integrator { kEuler, kParabolic };

// Names of the values of each choice, in the order of their numbers from 0; files and Python use them.
inline constexpr std::array<std::string_view, 2> names_of(StringLaw) {
  return {"pull_velocity", "inextensible"};
}
inline constexpr std::array<std::string_view, 2> names_of(Projection) { return {"radial", "closest_point"}; }
inline constexpr std::array<std::string_view, 2> names_of(NormalRule) { return {"published", "true"}; }
inline constexpr std::array<std::string_view, 3> names_of(FlightRule) {
  return {"published", "paper", "slack"};
}
inline constexpr std::array<std::string_view, 2> names_of(ThinRule) { return {"published", "paper"}; }
inline constexpr std::array<std::string_view, 2> names_of(SpinRule) { return {"slip", "length_change"}; }
inline constexpr std::array<std::string_view, 2> names_of(Integrator) { return {"euler", "parabolic"}; }

/// Name and meaning of a field that is a choice, a bool or a direction.
struct RuleInfo {
  const char *name, *meaning;
};

/// The rules and numbers of the paper's string, which acts under StringLaw::kPullVelocity.
template <class Scalar>
struct PullRules {
  Scalar mu_acceleration = Scalar(154.0);  ///< spin per string length, while the right strand grows [rad/m]
  Scalar mu_deceleration = Scalar(154.0);  ///< the same, while it shrinks [rad/m]
  Scalar pull_scale = Scalar(0.13);        ///< part of the correction that becomes velocity, before the cap
  Scalar cap_scale = Scalar(0.13);         ///< part of the spheroid's own motion that caps it
  Scalar pull_scale_after_cap = Scalar(0.07);  ///< per reference step
  /// The spheroid is thin when the tips are farther apart than L minus this [m].
  Scalar thin_slack = Scalar(0.05);
  Scalar reference_step = Scalar(1e-3);  ///< the step that the paper's per-step factors were found at [s]
  Projection projection = Projection::kClosestPoint;
  NormalRule normal_rule = NormalRule::kTrue;
  FlightRule flight_rule = FlightRule::kSlack;
  ThinRule thin_rule = ThinRule::kPaper;
  SpinRule spin_rule = SpinRule::kSlip;
  Integrator integrator = Integrator::kParabolic;
  /// Apply dissipation, spin coupling and pull as if every step were a reference step (the published rules),
  /// so that the motion depends on the step. false: the same factors in time constants.
  bool per_step = false;
  /// Tips farther apart than the string: let go for that step (published program) instead of holding the
  /// diabolo.
  bool release_when_overstretched = false;
};

}  // namespace diabolo
