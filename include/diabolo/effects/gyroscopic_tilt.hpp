// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"
#include "diabolo/string/string_path.hpp"

namespace diabolo {

/// A string that turns the axle of a spinning diabolo. A strand of direction e under the tension T leaves the
/// axle s at the radius r square to both and pulls with a torque whose part across s is r T (s.e) u, u the
/// direction of e without its part along s, of one sign for the left strand and of the other for the right
/// one. A gyroscope follows it slowly, ds/dt = torque / (I w): one hand forward and the other back tilts the
/// axle, both forward yaw it. gain = m r / I, about 3 to 8 1/m for the paper's diabolos; some degrees a
/// second in play.
///
/// For tips that are nearly square to the axle and for a spin that is fast: the nutation is left out, and
/// below kSlowSpin the law fades. Moves nothing by itself; lift and whoever looks at the axle see it.
template <class Scalar>
struct GyroscopicTilt : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "gyroscopic_tilt";
  static constexpr std::array kLaws{NamedLaw{
      "gyroscopic_tilt", "the tilt of the axle by the string", "axle", {"gyroscopic_gain"}, {}, "gain"}};
  static constexpr double kSlowSpin = 5.0;  ///< [rad/s]
  Scalar gain{0};  ///< mass times axle radius over the axial moment of inertia [1/m], >= 0

  bool neutral() const { return is_constant_zero(gain); }

  Vector3<Scalar> axis_rate(const State<Scalar>& state, const Tips<Scalar>& tips,
                            const StringStepResult<Scalar>& result, const Scalar& pull_difference) const {
    const StringPath<Scalar> path(result.position, tips);
    const Vector3<Scalar> left = path.from_left * Scalar(Scalar(-1) / path.left_length),
                          right = path.from_right * Scalar(Scalar(-1) / path.right_length);
    const Vector3<Scalar> both = left + right;
    // Mean tension over mass.
    const Scalar pull = select(
        result.taut, Scalar(norm(result.string_acceleration) / maximum(norm(both), Scalar(0.02))), Scalar(0));
    const Vector3<Scalar> torque = lever(state.axis, right) * Scalar(pull + Scalar(0.5) * pull_difference) -
                                   lever(state.axis, left) * Scalar(pull - Scalar(0.5) * pull_difference);
    // The left strand leaves the axle on the side of the left tip.
    const Scalar side = dot<Scalar>(cross<Scalar>(state.axis, both), tips.left - tips.right);
    const Scalar slow = state.spin / (state.spin * state.spin + Scalar(kSlowSpin * kSlowSpin));
    return torque * select(side > Scalar(0), Scalar(gain * slow), Scalar(-gain * slow));
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
  }

 private:
  /// (s.e) u.
  static Vector3<Scalar> lever(const Vector3<Scalar>& axis, const Vector3<Scalar>& strand) {
    const Scalar along = dot<Scalar>(axis, strand);
    const Vector3<Scalar> across = strand - axis * along;
    return across * Scalar(along / maximum(norm(across), Scalar(0.02)));
  }
};

}  // namespace diabolo
