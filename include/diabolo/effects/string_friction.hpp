// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"
#include "diabolo/effects/wound_contact.hpp"

namespace diabolo {

/// A string that rubs on the axle. Euler's and Eytelwein's capstan law: while the string slips towards the
/// right tip with the contact angle b, T_right / T_left = exp(coefficient b), so that the string's force
/// leans from the bisector of its segments by F tanh(coefficient b / 2) tan(e), e half the angle between them
/// (b = pi - 2 e, and 2 pi more for each wrap). The constraint keeps the normal force F; friction adds the
/// tangential part, and takes energy exactly where the string slips against it. String on a plastic or metal
/// axle: 0.1 to 0.35. The slip is that of the string's centre line, which passes a sticking axle at
/// Parameters::axle_radius times its spin: give it half the string's thickness more than the bare axle has.
///
/// The same difference of tensions turns the axle: dw/dt = spin_gain (T_right - T_left) / m, spin_gain = m r
/// / I (about 3 to 8 1/m for the paper's diabolos). It adds to the model's spin rule, which stands for the
/// same torque as a rate: with a gain, Parameters::spin_coupling is zero or what else couples string and
/// axle.
template <class Scalar>
struct StringFriction : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "string_friction";
  static constexpr std::array kLaws{NamedLaw{"string_friction",
                                             "friction of the string on the axle",
                                             "string_tangent",
                                             {"friction"},
                                             {"spin_gain"},
                                             "coefficient"}};
  /// Slip over which the sign of friction is smoothed [m/s].
  static constexpr double kSlipScale = 0.02;
  Scalar coefficient{0};  ///< capstan coefficient, >= 0
  Scalar spin_gain{0};    ///< mass times axle radius over the axial moment of inertia [1/m], >= 0

  bool neutral() const { return is_constant_zero(coefficient); }

  Contact<Scalar> contact(const State<Scalar>& state, const Tips<Scalar>& tips,
                          const StringStepResult<Scalar>& result, const Scalar& dt,
                          const Parameters<Scalar>& parameters, const Scalar& more) const {
    using std::atan2;
    using std::tanh;
    const Scalar rubbing =
        is_constant_zero(more) ? coefficient : maximum(Scalar(coefficient + more), Scalar(0));
    if (parameters.follow_turns)
      return wound_contact(rubbing, spin_gain, state, tips, result, dt, parameters);
    // Everything at the middle of the step: the strands, the slip and the normal force.
    const Scalar half = Scalar(0.5) * dt;
    const Vector3<Scalar> middle = (state.position + result.position) * Scalar(0.5);
    Tips<Scalar> there = tips;
    there.left -= tips.left_velocity * half;
    there.right -= tips.right_velocity * half;
    const StringPath<Scalar> path(middle, there);
    const Vector3<Scalar> left = path.from_left * Scalar(Scalar(-1) / path.left_length);
    const Vector3<Scalar> right = path.from_right * Scalar(Scalar(-1) / path.right_length);
    const Vector3<Scalar> across = right - left, along = right + left;
    const Scalar sine = norm(across), cosine = norm(along);  // twice those of e
    const Vector3<Scalar> tangent = across * Scalar(Scalar(1) / maximum(sine, tiny<Scalar>()));
    // Nearly straight strings have no tangent worth the name: the constraint holds the diabolo there.
    const Scalar thin = maximum(cosine, Scalar(0.02)), steepness = sine / thin;
    const Scalar exponent =
        rubbing * (atan2(cosine, sine) + Scalar(0.5) * wrapped_angle(parameters));  // half of coefficient b
    const Scalar largest = norm(result.string_acceleration) * dt * steepness;
    const Scalar slip = result.passed / dt - parameters.axle_radius * state.spin;
    const Scalar lean = tanh(exponent * tanh(slip_left(slip, Scalar(0.25) * sine * largest, exponent)));
    // The normal force was found without friction, which bends the path by what it does to the velocity.
    const Vector3<Scalar> velocity = (state.velocity + result.velocity) * Scalar(0.5);
    const Scalar bend =
        turn(left, tangent, Vector3<Scalar>(velocity - tips.left_velocity)) / path.left_length +
        turn(right, tangent, Vector3<Scalar>(velocity - tips.right_velocity)) / path.right_length;
    const Scalar feedback = tanh(half * lean * steepness * bend / thin);
    const Scalar impulse = select(result.taut, Scalar(largest * lean * (Scalar(1) + feedback)), Scalar(0));
    // The tensions' difference pulls along the tangent with the sine of e alone.
    const Scalar difference = impulse * Scalar(2) / maximum(sine, Scalar(0.02));
    // Along the taut string at the end of the step: what points off it would come back as tension.
    const Vector3<Scalar> normal = StringPath<Scalar>(result.position, tips).gradient();
    const Scalar off = dot(normal, tangent) / maximum(squared_norm(normal), Scalar(4e-4));
    return {(tangent - normal * off) * impulse, spin_gain * difference, difference / dt};
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"coefficient",
                        "1",
                        0.0,
                        3.0,
                        "capstan coefficient of string on axle",
                        {"friction", 0.1, 0.3, 0.0, 0.6}},
          self.coefficient);
    visit(ParameterInfo{"spin_gain",
                        "1/m",
                        0.0,
                        1e3,
                        "mass times axle radius over axial moment of inertia",
                        {"spin_gain", 1.0, 5.0, 0.0, 100.0}},
          self.spin_gain);
  }

 private:
  /// Slip [kSlipScale] at the middle of the step, friction counted: y + reach tanh(exponent tanh(y)) = slip /
  /// kSlipScale, with `reach` [m/s] what the largest friction takes away. Two steps of Newton's method from
  /// zero; the left side is concave, so that they never pass the root and friction never turns the slip.
  static Scalar slip_left(const Scalar& slip, const Scalar& reach, const Scalar& exponent) {
    using std::tanh;
    const Scalar wanted = slip / Scalar(kSlipScale), stiffness = reach / Scalar(kSlipScale);
    const Scalar y = wanted / (Scalar(1) + stiffness * exponent);
    const Scalar sign = tanh(y), lean = tanh(exponent * sign);
    const Scalar slope = exponent * (Scalar(1) - lean * lean) * (Scalar(1) - sign * sign);
    return y - (y + stiffness * lean - wanted) / (Scalar(1) + stiffness * slope);
  }

  /// Of the velocity v and the direction t, the product of the parts across the strand e.
  static Scalar turn(const Vector3<Scalar>& e, const Vector3<Scalar>& t, const Vector3<Scalar>& v) {
    return dot(t, v) - dot(e, t) * dot(e, v);
  }
};

}  // namespace diabolo
