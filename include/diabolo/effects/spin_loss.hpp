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
  static void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"air", "1/rad", 0.0, 1.0, "deceleration per squared spin"}, self.air);
    visit(ParameterInfo{"axle", "rad/s^2", 0.0, 1e4, "constant deceleration"}, self.axle);
  }
};

}  // namespace diabolo
