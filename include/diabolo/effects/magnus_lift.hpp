// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"

namespace diabolo {

/// Lift of a spinning diabolo: a = coefficient * omega x v with omega = -spin * axis the angular velocity;
/// positive as for a ball with back spin. Short cylinders lie at 2e-4 to 2e-3 1/rad. Does no work.
template <class Scalar>
struct MagnusLift : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "magnus_lift";
  static constexpr std::array kLaws{NamedLaw{"magnus_lift",
                                             "the lift of the spinning diabolo (Magnus)",
                                             "axis_x_v",
                                             {"lift"},
                                             {},
                                             "coefficient",
                                             false,
                                             true}};
  Scalar coefficient{0};  ///< [1/rad]

  bool neutral() const { return is_constant_zero(coefficient); }

  Vector3<Scalar> acceleration(const State<Scalar>& state, const Tips<Scalar>&, const Scalar& dt,
                               const Parameters<Scalar>&) const {
    // Solves a = turn x (v + a dt / 2), so that the velocity turns and keeps its length.
    const Vector3<Scalar> turn = state.axis * Scalar(-coefficient * state.spin);
    const Vector3<Scalar> begin = cross<Scalar>(turn, state.velocity);
    const Scalar half = Scalar(0.5) * dt, shorter = Scalar(1) + half * half * squared_norm(turn);
    return (begin + cross<Scalar>(turn, begin) * half) / shorter;
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"coefficient",
                        "1/rad",
                        -1.0,
                        1.0,
                        "acceleration per angular velocity and speed",
                        {"lift", 1e-3, 5e-3, -0.02, 0.02}},
          self.coefficient);
  }
};

}  // namespace diabolo
