// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"

namespace diabolo {

/// What a diagnosis looks for beside UnnamedForce: constant torques by the string's state, and a law that
/// nothing obeys, to be offered to it.
template <class Scalar>
struct LatentForce : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "latent_force";
  Scalar spin_string{0};  ///< ON_STRING, against the spin [rad/s^2]
  Scalar spin_free{0};    ///< off the string, against the spin [rad/s^2]
  Scalar placebo{0};      ///< against the velocity along x, and along no other axis [1/s]

  Vector3<Scalar> acceleration(const State<Scalar>& state, const Tips<Scalar>&, const Scalar&,
                               const Parameters<Scalar>&) const {
    return {Scalar(-(placebo * state.velocity.x())), Scalar(0), Scalar(0)};
  }

  Scalar spin_acceleration(const Scalar& spin, const State<Scalar>& state, const Tips<Scalar>&, const Scalar&,
                           const Parameters<Scalar>&) const {
    using std::tanh;
    const Scalar& rate = is(state.string_state, StringState::kOnString) ? spin_string : spin_free;
    return -(rate * tanh(spin));
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    const auto sought = [](std::string_view name) { return Sought{name, 1.0, 0.0, -100.0, 100.0}; };
    visit(ParameterInfo{"spin_string", "rad/s^2", -100.0, 100.0, "on the string, against the spin",
                        sought("spin_on_string")},
          self.spin_string);
    visit(ParameterInfo{"spin_free", "rad/s^2", -100.0, 100.0, "off the string, against the spin",
                        sought("spin_off_string")},
          self.spin_free);
    visit(ParameterInfo{"placebo",
                        "1/s",
                        -10.0,
                        10.0,
                        "against the velocity along x",
                        {"placebo", 0.1, 0.0, -10.0, 10.0}},
          self.placebo);
  }
};

}  // namespace diabolo
