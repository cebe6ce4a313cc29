// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"

namespace diabolo {

/// Lift of a spinning diabolo: a = coefficient * omega x v with omega the angular velocity, positive as for a
/// ball with back spin. Short cylinders lie at 2e-4 to 2e-3 1/rad. Does no work. The axis does not turn
/// within a rollout; its default is level and forward, where positive spin is rotation about -x.
template <class Scalar>
struct MagnusLift : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "magnus_lift";
  Scalar coefficient{0};                   ///< [1/rad]
  Scalar axis_x{1}, axis_y{0}, axis_z{0};  ///< of the axle, forward, world frame; a unit vector

  Vector3<Scalar> acceleration(const State<Scalar>& state, const Tips<Scalar>&,
                               const Parameters<Scalar>&) const {
    const Vector3<Scalar>& v = state.velocity;
    const Vector3<Scalar> axis_cross_v(axis_y * v[2] - axis_z * v[1], axis_z * v[0] - axis_x * v[2],
                                       axis_x * v[1] - axis_y * v[0]);
    return axis_cross_v * Scalar(-coefficient * state.spin);
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"coefficient", "1/rad", -1.0, 1.0, "acceleration per angular velocity and speed"},
          self.coefficient);
    visit(ParameterInfo{"axis_x", "1", -1.0, 1.0, "axle's direction, forward"}, self.axis_x);
    visit(ParameterInfo{"axis_y", "1", -1.0, 1.0, "axle's direction, to the left"}, self.axis_y);
    visit(ParameterInfo{"axis_z", "1", -1.0, 1.0, "axle's direction, up"}, self.axis_z);
  }
};

}  // namespace diabolo
