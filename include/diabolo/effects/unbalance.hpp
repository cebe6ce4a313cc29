// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"

namespace diabolo {

/// Cups of unlike weight: the centre of mass lies beside the groove by `offset` along the axle s. The
/// string's force F has that lever about it, the torque is -offset s x F, and a diabolo that hangs still yaws
/// about the vertical at m g offset / (I w), as a top does (Goldstein, Classical Mechanics, the heavy top),
/// where GyroscopicTilt has its gain m r / I. The state's position stays the groove's middle; what the centre
/// of mass needs to be accelerated while the axle turns, offset times the axle's angular acceleration, is
/// left out.
template <class Scalar>
struct Unbalance : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "unbalance";
  static constexpr std::array kLaws{
      NamedLaw{"unbalance", "cups of unlike weight", "axle", {"unbalance_offset"}, {}, "offset", false}};
  Scalar offset{0};  ///< of the centre of mass from the groove's middle, along the axle [m]

  bool neutral() const { return is_constant_zero(offset); }

  Vector3<Scalar> axle_torque(const State<Scalar>& state, const Tips<Scalar>& tips,
                              const StringStepResult<Scalar>& result, const Scalar& pull_difference,
                              const Parameters<Scalar>& parameters) const {
    return cross<Scalar>(state.axis, force_of_string(tips, result, pull_difference)) *
           Scalar(-offset / parameters.axle_radius);
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"offset",
                        "m",
                        -0.1,
                        0.1,
                        "of the centre of mass from the groove's middle, along the axle",
                        {"unbalance_offset", 1e-3, 0.0, -0.02, 0.02}},
          self.offset);
  }
};

}  // namespace diabolo
