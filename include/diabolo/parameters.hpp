// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "diabolo/math/fields.hpp"
#include "diabolo/rules.hpp"

namespace diabolo {

/// Everything that the predictor can be told. Start from a preset, change fields, hand it to a Predictor,
/// which checks it once.
template <class Scalar>
struct Parameters {
  Scalar string_length = Scalar(1.45);        ///< L [m]
  Scalar gravity = Scalar(kStandardGravity);  ///< [m/s^2], along -z
  Scalar mass = Scalar(0.2845);               ///< of the diabolo [kg]; default: the paper's red one
  Scalar axle_radius = Scalar(0.0065);        ///< r [m]
  /// Whole turns of the string around the axle beyond the pass under it; with follow_turns, at the beginning.
  Scalar wraps = Scalar(0);
  Scalar spin_coupling = Scalar(0.15);    ///< rate at which slip is worn off (SpinRule::kSlip) [1/s]
  Scalar dissipation_rate = Scalar(0.0);  ///< decay of the velocity while ON_STRING [1/s]
  Scalar loose_distance = Scalar(0.01);   ///< c_L [m]
  Scalar flying_distance = Scalar(0.05);  ///< c_F [m]
  Scalar catch_slack = Scalar(0.03);      ///< a catch needs tips no closer than L minus this [m]
  Scalar catch_distance = Scalar(0.10);   ///< and the diabolo no farther from the line of the tips [m]
  StringLaw string_law = StringLaw::kInextensible;
  /// Turns of the string around the axle come and go (string/winding.hpp); else there are always `wraps`.
  bool follow_turns = false;
  /// Keep position and velocity in the plane through the start position with the normal `plane_normal`.
  bool planar = false;
  Vector3<double> plane_normal = Vector3<double>::UnitX();
  PullRules<Scalar> pull;  ///< of the paper's string, which alone they concern

  /// Inextensible massless string without friction; results converge as the step goes to zero. The default.
  static Parameters consistent() { return {}; }

  /// The rules of the paper's text with its errata corrected (docs/models.md lists them).
  static Parameters paper() {
    Parameters p;
    p.gravity = Scalar(9.8);
    p.dissipation_rate = Scalar(kPublishedDissipationRate);
    p.string_law = StringLaw::kPullVelocity;
    p.pull.flight_rule = FlightRule::kPaper;
    p.pull.spin_rule = SpinRule::kLengthChange;
    p.pull.integrator = Integrator::kEuler;
    p.pull.per_step = true;
    return p;
  }

  /// The authors' program, rule by rule, with the settings of its evaluation.
  static Parameters published() {
    Parameters p = paper();
    p.string_length = Scalar(1.46);
    p.pull.thin_slack = Scalar(0.03);
    p.pull.projection = Projection::kRadial;
    p.pull.normal_rule = NormalRule::kPublished;
    p.pull.flight_rule = FlightRule::kPublished;
    p.pull.thin_rule = ThinRule::kPublished;
    p.pull.spin_rule = SpinRule::kSlip;
    p.pull.integrator = Integrator::kParabolic;
    p.pull.release_when_overstretched = true;
    return p;
  }

  /// What is not numeric, in the order of rules_of().
  static constexpr std::array<RuleInfo, 12> kRules{{
      {"string_law", "how the string acts on the diabolo"},
      {"projection", "where a diabolo outside the spheroid is put back"},
      {"normal_rule", "which direction counts as the spheroid's normal"},
      {"flight_rule", "when the diabolo leaves the string and comes back to it"},
      {"thin_rule", "what happens to the pull when the spheroid is thin"},
      {"spin_rule", "how passing string drives the spin"},
      {"integrator", "of the free motion"},
      {"per_step",
       "apply the factors as if every step were a reference step, so that the motion depends on the step"},
      {"release_when_overstretched",
       "let go where the tips are farther apart than the string, instead of holding the diabolo"},
      {"follow_turns", "let turns of the string around the axle come and go, from `wraps` on"},
      {"planar", "keep the diabolo in the plane through its start square to plane_normal"},
      {"plane_normal", "unit vector, shape (3,)"},
  }};

  /// References to everything that is not numeric.
  template <class Self>
  static auto rules_of(Self& self) {
    auto& pull = self.pull;
    return std::tie(self.string_law, pull.projection, pull.normal_rule, pull.flight_rule, pull.thin_rule,
                    pull.spin_rule, pull.integrator, pull.per_step, pull.release_when_overstretched,
                    self.follow_turns, self.planar, self.plane_normal);
  }

  /// Calls `visit(info, field)` for everything that is not numeric: choices, bools, and the plane's normal.
  template <class Self, class Visitor>
  static void for_each_rule(Self& self, Visitor&& visit) {
    std::size_t next = 0;
    std::apply([&](auto&... rule) { (visit(kRules[next++], rule), ...); }, rules_of(self));
  }

  /// Takes over everything that is not numeric.
  template <class Other>
  void copy_rules(const Parameters<Other>& other) {
    rules_of(*this) = Parameters<Other>::rules_of(other);
  }

  /// Whether everything that is not numeric agrees.
  template <class Other>
  bool same_rules(const Parameters<Other>& other) const {
    return rules_of(*this) == Parameters<Other>::rules_of(other);
  }

  /// Calls `visit(info, field)` for every numeric field.
  template <class Self, class Visitor>
  static void for_each(Self& self, Visitor&& visit) {
    using Info = ParameterInfo;
    visit(Info{"string_length", "m", 0.05, 20.0, "length of the string between the tips"},
          self.string_length);
    visit(Info{"gravity", "m/s^2", 0.0, 100.0, "acceleration of gravity, downwards"}, self.gravity);
    visit(Info{"mass", "kg", 1e-3, 10.0, "mass of the diabolo"}, self.mass);
    visit(Info{"axle_radius", "m", 1e-4, 0.1, "radius of the axle"}, self.axle_radius);
    visit(Info{"wraps", "1", 0.0, 5.0, "whole turns of the string around the axle beyond the pass under it"},
          self.wraps);
    visit(Info{"spin_coupling", "1/s", 0.0, 1e3, "rate at which slip on the axle is worn off"},
          self.spin_coupling);
    visit(Info{"mu_acceleration", "rad/m", 0.0, 1e4, "paper: spin per growth of the right strand"},
          self.pull.mu_acceleration);
    visit(Info{"mu_deceleration", "rad/m", 0.0, 1e4, "paper: spin per shrinking of the right strand"},
          self.pull.mu_deceleration);
    visit(Info{"dissipation_rate", "1/s", 0.0, 1e3, "decay of the velocity while on the string"},
          self.dissipation_rate);
    visit(Info{"pull_scale", "1", 0.0, 1.0,
               "paper: part of the correction that becomes velocity, before the cap"},
          self.pull.pull_scale);
    visit(Info{"cap_scale", "1", 0.0, 1.0, "paper: part of the spheroid's motion that caps the pull"},
          self.pull.cap_scale);
    visit(Info{"pull_scale_after_cap", "1", 0.0, 1.0,
               "paper: damping of the pull after the cap, per reference step"},
          self.pull.pull_scale_after_cap);
    visit(Info{"loose_distance", "m", 0.0, 1.0, "paper's c_L"}, self.loose_distance);
    visit(Info{"flying_distance", "m", 0.0, 1.0, "paper's c_F"}, self.flying_distance);
    visit(
        Info{"catch_slack", "m", 0.0, 20.0, "a catch needs tips no closer than the string length minus this"},
        self.catch_slack);
    visit(
        Info{"catch_distance", "m", 0.0, 1.0, "a catch needs the diabolo this close to the line of the tips"},
        self.catch_distance);
    visit(Info{"thin_slack", "m", 0.0, 20.0,
               "the spheroid is thin when the tips are farther apart than L minus this"},
          self.pull.thin_slack);
    visit(Info{"reference_step", "s", 1e-6, 0.1, "step that the per-step factors are stated for"},
          self.pull.reference_step);
  }

  /// Throws std::invalid_argument naming the first field that is out of its range, its value and the range.
  void validate() const {
    validate_fields<Scalar>(*this);
    if (!all(spin_coupling * pull.reference_step <= Scalar(1)))
      throw std::invalid_argument("spin_coupling: times reference_step must not exceed 1");
    if (follow_turns && string_law != StringLaw::kInextensible)
      throw std::invalid_argument(
          "follow_turns: true under the string law 'pull_velocity'; expected 'inextensible'");
    if (planar && !(std::abs(plane_normal.norm() - 1.0) < 1e-9))
      throw std::invalid_argument("plane_normal: must be a unit vector");
  }

 private:
  static constexpr double kPublishedDissipationRate = 0.10000500033334732;  // -ln(0.9999) per 1 ms
};

/// That the string's wraps add to its contact angle [rad].
template <class Scalar>
Scalar wrapped_angle(const Parameters<Scalar>& parameters) {
  return Scalar(2.0 * std::numbers::pi) * parameters.wraps;
}

}  // namespace diabolo
