// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"

namespace diabolo {

/// A string that rubs on the axle. Euler's and Eytelwein's capstan law: while the string slips towards the
/// right tip with the contact angle b, T_right / T_left = exp(coefficient b), so that the string's force
/// leans from the bisector of its segments by F tanh(coefficient b / 2) tan(e), e half the angle between them
/// (b = pi - 2 e). The constraint keeps the normal force F; friction adds the tangential part, and takes
/// energy exactly where the string slips against it. String on a plastic or metal axle: 0.1 to 0.35.
///
/// Its torque on the spin is the model's spin rule, whose coefficient a recording tells separately.
template <class Scalar>
struct StringFriction : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "string_friction";
  /// Slip over which the sign of friction is smoothed [m/s].
  static constexpr double kSlipScale = 0.02;
  Scalar coefficient{0};  ///< capstan coefficient, >= 0

  bool neutral() const { return is_constant_zero(coefficient); }

  Vector3<Scalar> contact_impulse(const State<Scalar>& state, const Tips<Scalar>& tips,
                                  const StringStepResult<Scalar>& result, const Scalar& dt,
                                  const Parameters<Scalar>& parameters) const {
    using std::atan2;
    using std::tanh;
    const Vector3<Scalar> to_left = tips.left - result.position, to_right = tips.right - result.position;
    const Vector3<Scalar> left = to_left * Scalar(Scalar(1) / norm(to_left));
    const Vector3<Scalar> right = to_right * Scalar(Scalar(1) / norm(to_right));
    const Vector3<Scalar> across = right - left, along = right + left;
    const Scalar sine = norm(across), cosine = norm(along);  // twice those of e
    const Scalar contact = Scalar(2) * atan2(cosine, sine);
    const Scalar slip = result.passed / dt - parameters.axle_radius * state.spin;
    const Scalar lean = tanh(Scalar(0.5) * coefficient * contact * tanh(slip / Scalar(kSlipScale)));
    // Nearly straight strings have no tangent worth the name: the constraint holds the diabolo there.
    const Scalar tangent = sine / maximum(cosine, Scalar(0.02));
    const Scalar impulse = norm(result.string_acceleration) * dt * lean * tangent;
    return across * Scalar(select(result.taut, impulse, Scalar(0)) / maximum(sine, tiny<Scalar>()));
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"coefficient", "1", 0.0, 3.0, "capstan coefficient of string on axle"},
          self.coefficient);
  }
};

}  // namespace diabolo
