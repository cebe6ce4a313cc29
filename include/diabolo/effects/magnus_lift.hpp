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
  Scalar coefficient{0};  ///< [1/rad]

  bool neutral() const { return is_constant_zero(coefficient); }

  Vector3<Scalar> acceleration(const State<Scalar>& state, const Tips<Scalar>&,
                               const Parameters<Scalar>&) const {
    const Vector3<Scalar>&v = state.velocity, &a = state.axis;
    const Vector3<Scalar> axis_cross_v(a[1] * v[2] - a[2] * v[1], a[2] * v[0] - a[0] * v[2],
                                       a[0] * v[1] - a[1] * v[0]);
    return axis_cross_v * Scalar(-coefficient * state.spin);
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"coefficient", "1/rad", -1.0, 1.0, "acceleration per angular velocity and speed"},
          self.coefficient);
  }
};

}  // namespace diabolo
