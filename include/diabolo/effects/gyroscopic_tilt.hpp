// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"
#include "diabolo/math/pairs.hpp"
#include "diabolo/string/string_path.hpp"
#include "diabolo/string/winding.hpp"

namespace diabolo {

/// A string that turns the axle of a spinning diabolo. A strand of direction e under the tension T leaves the
/// axle s at the radius r square to both and pulls with a torque whose part across s is r T (s.e) u, u the
/// direction of e without its part along s, of one sign for the left strand and of the other for the right
/// one. gain = m r / I, I the axial moment of inertia; about 3 to 8 1/m for the paper's diabolos.
///
/// With an `inertia_ratio` the diabolo is a rigid body, a symmetric top: its angular momentum, over the
/// transverse moment of inertia, is l = tumble - spin s / inertia_ratio; the torque changes l, and s turns
/// about l, ds/dt = l x s (Euler's equations in the world frame). It nutes with some spin / inertia_ratio,
/// in flight too, which the step has to resolve.
///
/// Without one it is the limit of a fast spin: no nutation, ds/dt = torque / (I w). One hand forward and the
/// other back tilts the axle, both forward yaw it; some degrees a second in play. Below kSlowSpin that law
/// fades.
template <class Scalar>
struct GyroscopicTilt : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "gyroscopic_tilt";
  static constexpr std::array kLaws{NamedLaw{
      "gyroscopic_tilt", "the tilt of the axle by the string", "axle", {"gyroscopic_gain"}, {}, "gain"}};
  static constexpr double kSlowSpin = 5.0;  ///< [rad/s]
  Scalar gain{0};           ///< mass times axle radius over the axial moment of inertia [1/m], >= 0
  Scalar inertia_ratio{0};  ///< transverse over axial moment of inertia; zero: no nutation
  Scalar decay{0};          ///< of the nutation, by the air and by what gives [1/s], >= 0

  bool neutral() const { return is_constant_zero(gain) && !tumbles(); }
  bool tumbles() const { return any(inertia_ratio > Scalar(0)); }

  Vector3<Scalar> axle_torque(const State<Scalar>& state, const Tips<Scalar>& tips,
                              const StringStepResult<Scalar>& result, const Scalar& pull_difference,
                              const Parameters<Scalar>& parameters) const {
    const auto [left, right] = StringPath<Scalar>(result.position, tips).directions();
    // Mean tension over mass; the sum of both directions has the square 2 + 2 left.right.
    const Scalar both = maximum(Scalar(2) + Scalar(2) * dot<Scalar>(left, right), Scalar(4e-4));
    const Scalar pull =
        select(result.taut || result.snapped_taut,
               positive_sqrt<Scalar>(squared_norm(result.string_acceleration) / both), Scalar(0));
    const auto [left_lever, right_lever] =
        levers(Scalar(dot<Scalar>(state.axis, left)), Scalar(dot<Scalar>(state.axis, right)));
    const Vector3<Scalar> torque =
        across(state.axis, left * Scalar(left_lever * (pull - Scalar(0.5) * pull_difference)) -
                               right * Scalar(right_lever * (pull + Scalar(0.5) * pull_difference)));
    // The left strand leaves the axle on the side of the left tip, but where the string's turns are followed:
    // strands that cross leave it on the other side of each other.
    const Scalar side = parameters.follow_turns ? Scalar(-side_of_axle(state, parameters))
                                                : dot<Scalar>(state.axis, cross<Scalar>(right, left));
    return select<Scalar>(side > Scalar(0), torque, Vector3<Scalar>(-torque));
  }

  void turn_axle(State<Scalar>& state, const Vector3<Scalar>& torque, const Scalar& dt) const {
    const Mask<Scalar> rigid = inertia_ratio > Scalar(0);
    const Vector3<Scalar> followed = all(rigid) ? state.axis : after_slow_turn(state, torque, dt);
    if (any(rigid)) {
      const Scalar lightness = Scalar(1) / select(rigid, inertia_ratio, Scalar(1)), half = Scalar(0.5) * dt;
      // Half of the torque's kick before the axle turns about the momentum, half after: second order.
      const Vector3<Scalar> kick = torque * Scalar(half * gain * lightness);
      const Vector3<Scalar> momentum = state.tumble - state.axis * Scalar(state.spin * lightness) + kick;
      state.axis = select<Scalar>(rigid, turned_about(momentum * half, state.axis), followed);
      const Vector3<Scalar> tumble =
          across(state.axis, momentum + kick) * Scalar(Scalar(1) / (Scalar(1) + decay * dt));
      state.tumble = select<Scalar>(rigid, tumble, state.tumble);
    } else {
      state.axis = followed;
    }
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"gain",
                        "1/m",
                        0.0,
                        1e3,
                        "mass times axle radius over axial moment of inertia",
                        {"gyroscopic_gain", 1.0, 0.0, 0.0, 100.0}},
          self.gain);
    visit(ParameterInfo{"inertia_ratio", "1", 0.0, 100.0,
                        "transverse over axial moment of inertia; zero: no nutation"},
          self.inertia_ratio);
    visit(ParameterInfo{"decay", "1/s", 0.0, 1e3, "decay of the nutation"}, self.decay);
  }

 private:
  /// Without its part along the axle.
  static Vector3<Scalar> across(const Vector3<Scalar>& axle, const Vector3<Scalar>& v) {
    return v - axle * dot<Scalar>(axle, v);
  }

  /// What (s.e) u is to the part of e across s, for two strands of such s.e.
  static std::array<Scalar, 2> levers(const Scalar& left, const Scalar& right) {
    const Scalar least = Scalar(4e-4);
    const auto [left_size, right_size] = square_roots(maximum(Scalar(Scalar(1) - left * left), least),
                                                      maximum(Scalar(Scalar(1) - right * right), least));
    return quotients(left, right, left_size, right_size);
  }

  /// The vector turned about twice the angle `half` [rad], by Cayley's map: a rotation whatever its size,
  /// right to second order.
  static Vector3<Scalar> turned_about(const Vector3<Scalar>& half, const Vector3<Scalar>& v) {
    const Vector3<Scalar> once = cross<Scalar>(half, v), twice = cross<Scalar>(half, once);
    return v + (once + twice) * Scalar(Scalar(2) / (Scalar(1) + squared_norm<Scalar>(half)));
  }

  /// The axle that follows the torque without nutation.
  Vector3<Scalar> after_slow_turn(const State<Scalar>& state, const Vector3<Scalar>& torque,
                                  const Scalar& dt) const {
    const Scalar slow = state.spin / (state.spin * state.spin + Scalar(kSlowSpin * kSlowSpin));
    const Vector3<Scalar> turned = state.axis + torque * Scalar(-(gain * slow)) * dt;
    return turned * Scalar(norm(state.axis) / norm(turned));
  }
};

}  // namespace diabolo
