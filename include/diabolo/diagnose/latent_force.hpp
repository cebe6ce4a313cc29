// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"

namespace diabolo {

/// Constant accelerations in the directions that tell physics apart, by the string's state: how a diagnosis
/// sees where something is missing before it has a name for it. And a law that nothing obeys, to be offered
/// to it.
template <class Scalar>
struct LatentForce : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "latent_force";
  Scalar string_tangent{0};   ///< ON_STRING, in the string's plane, towards the right tip [m/s^2]
  Scalar string_binormal{0};  ///< ON_STRING, square to the string's plane [m/s^2]
  Scalar flight_against{0};   ///< off the string, against the velocity [m/s^2]
  Scalar flight_vertical{0};  ///< off the string, up [m/s^2]
  Scalar flight_lift{0};      ///< off the string, along omega x v [m/s^2]
  Scalar spin_string{0};      ///< ON_STRING, against the spin [rad/s^2]
  Scalar spin_free{0};        ///< off the string, against the spin [rad/s^2]
  Scalar placebo{0};          ///< against the velocity along x, and along no other axis [1/s]

  Vector3<Scalar> acceleration(const State<Scalar>& state, const Tips<Scalar>& tips, const Scalar&,
                               const Parameters<Scalar>&) const {
    const Vector3<Scalar> along_x(-(placebo * state.velocity.x()), Scalar(0), Scalar(0));
    if (is(state.string_state, StringState::kOnString)) {
      const Vector3<Scalar> left = unit(tips.left - state.position),
                            right = unit(tips.right - state.position);
      return along_x + unit(right - left) * string_tangent + unit(cross(left, right)) * string_binormal;
    }
    const Scalar sign = state.spin > Scalar(0) ? Scalar(-1) : Scalar(1);
    return along_x - unit(state.velocity) * flight_against +
           unit(cross(state.axis, state.velocity)) * (flight_lift * sign) +
           Vector3<Scalar>(Scalar(0), Scalar(0), flight_vertical);
  }

  Scalar spin_acceleration(const Scalar& spin, const State<Scalar>& state, const Scalar&,
                           const Parameters<Scalar>&) const {
    using std::tanh;
    const Scalar& rate = is(state.string_state, StringState::kOnString) ? spin_string : spin_free;
    return -(rate * tanh(spin));
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static void for_each(Self&, Visitor&&) {}

 private:
  /// Of length one; shorter than that below 1e-3, smoothly, down to nothing.
  static Vector3<Scalar> unit(const Vector3<Scalar>& v) {
    using std::sqrt;
    return v * Scalar(Scalar(1) / sqrt(squared_norm(v) + Scalar(1e-6)));
  }
};

}  // namespace diabolo
