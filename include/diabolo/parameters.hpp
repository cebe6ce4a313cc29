// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
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

/// Name, unit and range of a numeric parameter.
struct ParameterInfo {
  std::string_view name, unit;
  double minimum, maximum;
  std::string_view meaning;
};

/// Throws std::invalid_argument naming the first field of `Fields::for_each` that is out of its range, its
/// value and the range.
template <class Scalar, class Fields>
void validate_fields(const Fields& fields, const std::string& prefix = {}) {
  Fields::for_each(fields, [&](const ParameterInfo& info, const Scalar& field) {
    if (all(field >= Scalar(info.minimum)) && all(field <= Scalar(info.maximum))) return;
    std::ostringstream text;
    text << prefix << info.name << ": ";
    if constexpr (std::floating_point<Scalar>) text << field << ' ' << info.unit << "; ";
    text << "must be within [" << info.minimum << ", " << info.maximum << "] " << info.unit;
    throw std::invalid_argument(text.str());
  });
}

/// Everything that the predictor can be told. Start from a preset, change fields, hand it to a Predictor,
/// which checks it once.
template <class Scalar>
struct Parameters {
  Scalar string_length = Scalar(1.45);        ///< L [m]
  Scalar gravity = Scalar(kStandardGravity);  ///< [m/s^2], along -z
  Scalar mass = Scalar(0.2845);               ///< of the diabolo [kg]; default: the paper's red one
  Scalar axle_radius = Scalar(0.0065);        ///< r [m]
  Scalar wraps = Scalar(0);  ///< whole turns of the string around the axle beyond the pass under it
  Scalar spin_coupling = Scalar(0.15);     ///< rate at which slip is worn off (SpinRule::kSlip) [1/s]
  Scalar mu_acceleration = Scalar(154.0);  ///< spin per string length, while the right strand grows [rad/m]
  Scalar mu_deceleration = Scalar(154.0);  ///< the same, while it shrinks [rad/m]
  Scalar dissipation_rate = Scalar(0.0);   ///< decay of the velocity while ON_STRING [1/s]
  Scalar pull_scale = Scalar(0.13);        ///< part of the correction that becomes velocity, before the cap
  Scalar cap_scale = Scalar(0.13);         ///< part of the spheroid's own motion that caps it
  Scalar pull_scale_after_cap = Scalar(0.07);  ///< per reference step
  Scalar loose_distance = Scalar(0.01);        ///< c_L [m]
  Scalar flying_distance = Scalar(0.05);       ///< c_F [m]
  Scalar catch_slack = Scalar(0.03);           ///< a catch needs tips no closer than L minus this [m]
  Scalar catch_distance = Scalar(0.10);        ///< and the diabolo no farther from the line of the tips [m]
  Scalar thin_slack =
      Scalar(0.05);  ///< the spheroid is thin when the tips are farther apart than L minus this [m]
  Scalar reference_step = Scalar(1e-3);  ///< the step that the paper's per-step factors were found at [s]
  StringLaw string_law = StringLaw::kInextensible;
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
  /// Keep position and velocity in the plane through the start position with the normal `plane_normal`.
  bool planar = false;
  Vector3<double> plane_normal = Vector3<double>::UnitX();

  /// Inextensible massless string without friction; results converge as the step goes to zero. The default.
  static Parameters consistent() { return {}; }

  /// The rules of the paper's text with its errata corrected (docs/models.md lists them).
  static Parameters paper() {
    Parameters p;
    p.gravity = Scalar(9.8);
    p.dissipation_rate = Scalar(kPublishedDissipationRate);
    p.string_law = StringLaw::kPullVelocity;
    p.flight_rule = FlightRule::kPaper;
    p.spin_rule = SpinRule::kLengthChange;
    p.integrator = Integrator::kEuler;
    p.per_step = true;
    return p;
  }

  /// The authors' program, rule by rule, with the settings of its evaluation.
  static Parameters published() {
    Parameters p = paper();
    p.string_length = Scalar(1.46);
    p.thin_slack = Scalar(0.03);
    p.projection = Projection::kRadial;
    p.normal_rule = NormalRule::kPublished;
    p.flight_rule = FlightRule::kPublished;
    p.thin_rule = ThinRule::kPublished;
    p.spin_rule = SpinRule::kSlip;
    p.integrator = Integrator::kParabolic;
    p.release_when_overstretched = true;
    return p;
  }

  /// Takes over everything that is not numeric.
  template <class Other>
  void copy_rules(const Parameters<Other>& other) {
    string_law = other.string_law;
    projection = other.projection;
    normal_rule = other.normal_rule;
    flight_rule = other.flight_rule;
    thin_rule = other.thin_rule;
    spin_rule = other.spin_rule;
    integrator = other.integrator;
    per_step = other.per_step;
    release_when_overstretched = other.release_when_overstretched;
    planar = other.planar;
    plane_normal = other.plane_normal;
  }

  /// Whether everything that is not numeric agrees.
  template <class Other>
  bool same_rules(const Parameters<Other>& other) const {
    return string_law == other.string_law && projection == other.projection &&
           normal_rule == other.normal_rule && flight_rule == other.flight_rule &&
           thin_rule == other.thin_rule && spin_rule == other.spin_rule && integrator == other.integrator &&
           per_step == other.per_step && release_when_overstretched == other.release_when_overstretched &&
           planar == other.planar && plane_normal == other.plane_normal;
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
          self.mu_acceleration);
    visit(Info{"mu_deceleration", "rad/m", 0.0, 1e4, "paper: spin per shrinking of the right strand"},
          self.mu_deceleration);
    visit(Info{"dissipation_rate", "1/s", 0.0, 1e3, "decay of the velocity while on the string"},
          self.dissipation_rate);
    visit(Info{"pull_scale", "1", 0.0, 1.0,
               "paper: part of the correction that becomes velocity, before the cap"},
          self.pull_scale);
    visit(Info{"cap_scale", "1", 0.0, 1.0, "paper: part of the spheroid's motion that caps the pull"},
          self.cap_scale);
    visit(Info{"pull_scale_after_cap", "1", 0.0, 1.0,
               "paper: damping of the pull after the cap, per reference step"},
          self.pull_scale_after_cap);
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
          self.thin_slack);
    visit(Info{"reference_step", "s", 1e-6, 0.1, "step that the per-step factors are stated for"},
          self.reference_step);
  }

  /// Throws std::invalid_argument naming the first field that is out of its range, its value and the range.
  void validate() const {
    validate_fields<Scalar>(*this);
    if (!all(spin_coupling * reference_step <= Scalar(1)))
      throw std::invalid_argument("spin_coupling: times reference_step must not exceed 1");
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
