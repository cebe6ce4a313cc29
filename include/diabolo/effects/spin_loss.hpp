// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"

namespace diabolo {

/// What slows the spin beside the string: dw/dt = -air w|w| - axle sign(w). Air acts on the cups all the time
/// (a disc in turbulent flow: some 5e-5 1/rad for the paper's diabolos); `axle` is a constant torque over the
/// moment of inertia, such as that of a bearing, until the spin rests. Each is exact over a step.
template <class Scalar>
struct SpinLoss : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "spin_loss";
  static constexpr std::array kLaws{
      NamedLaw{
          "spin_drag", "the air that slows the spin", "spin", {"spin_air"}, {}, "coefficient", true, true},
      NamedLaw{"axle_drag", "a bearing that slows the spin", "spin", {"spin_axle"}, {}, "rate", true, true}};
  Scalar air{0};   ///< [1/rad], >= 0
  Scalar axle{0};  ///< [rad/s^2], >= 0

  bool neutral() const { return is_constant_zero(air) && is_constant_zero(axle); }

  Scalar spin_acceleration(const Scalar& spin, const State<Scalar>&, const Tips<Scalar>&, const Scalar& dt,
                           const Parameters<Scalar>&) const {
    const Scalar kept = Scalar(1) / (Scalar(1) + air * absolute(spin) * dt);
    const Scalar braking = select(spin < Scalar(0), Scalar(-axle), axle);
    const Scalar stopping = kept * spin / dt;  // the deceleration that leaves no spin
    return -(air * absolute(spin) * kept * spin) - select(absolute(stopping) < axle, stopping, braking);
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(
        ParameterInfo{
            "air", "1/rad", 0.0, 1.0, "deceleration per squared spin", {"spin_air", 1e-3, 5e-3, 0.0, 0.02}},
        self.air);
    visit(
        ParameterInfo{
            "axle", "rad/s^2", 0.0, 1e4, "constant deceleration", {"spin_axle", 1.0, 20.0, 0.0, 60.0}},
        self.axle);
  }
};

}  // namespace diabolo
