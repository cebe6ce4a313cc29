// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"

namespace diabolo {

/// Air that holds the diabolo back: a = -(rate + coefficient |u|) u with u = v - wind its velocity through
/// the air. At the speeds of play (Reynolds number 1e4 to 1e5) the quadratic law is the physical one, with
/// coefficient = air density * drag coefficient * area / (2 mass), 0.015 to 0.045 1/m for a drag coefficient
/// of 0.6 to 1.5; the linear law stands for whatever else grows with speed alone.
template <class Scalar>
struct Air : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "air";
  static constexpr std::array kLaws{
      NamedLaw{"air_drag_linear", "a drag that grows with speed", "against_v", {"linear_drag"}, {}, "rate"},
      NamedLaw{
          "air_drag_quadratic", "the drag of the air", "against_v", {"quadratic_drag"}, {}, "coefficient"},
      NamedLaw{"wind", "wind", "horizontal", {"wind_x", "wind_y"}, {}, {}, false}};
  Scalar linear_drag{0};     ///< [1/s], >= 0
  Scalar quadratic_drag{0};  ///< [1/m], >= 0
  Scalar wind_x{0};          ///< horizontal velocity of the air, world frame [m/s]
  Scalar wind_y{0};          ///< [m/s]

  bool neutral() const { return is_constant_zero(linear_drag) && is_constant_zero(quadratic_drag); }

  Vector3<Scalar> acceleration(const State<Scalar>& state, const Tips<Scalar>&, const Scalar& dt,
                               const Parameters<Scalar>&) const {
    const Vector3<Scalar> through_air = state.velocity - Vector3<Scalar>(wind_x, wind_y, Scalar(0));
    // No step takes more than all of the velocity through the air.
    const Scalar rate = linear_drag + quadratic_drag * norm(through_air);
    return through_air * Scalar(-minimum(rate, Scalar(Scalar(1) / dt)));
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(
        ParameterInfo{
            "linear_drag", "1/s", 0.0, 10.0, "deceleration per speed", {"linear_drag", 0.1, 0.3, 0.0, 1.0}},
        self.linear_drag);
    visit(ParameterInfo{"quadratic_drag",
                        "1/m",
                        0.0,
                        10.0,
                        "deceleration per squared speed",
                        {"quadratic_drag", 0.1, 0.15, 0.0, 0.5}},
          self.quadratic_drag);
    visit(
        ParameterInfo{
            "wind_x", "m/s", -100.0, 100.0, "velocity of the air, forward", {"wind_x", 1.0, 3.0, -6.0, 6.0}},
        self.wind_x);
    visit(ParameterInfo{"wind_y",
                        "m/s",
                        -100.0,
                        100.0,
                        "velocity of the air, to the left",
                        {"wind_y", 1.0, 3.0, -6.0, 6.0}},
          self.wind_y);
  }
};

}  // namespace diabolo
