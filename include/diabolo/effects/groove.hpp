// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"
#include "diabolo/string/string_path.hpp"

namespace diabolo {

/// A string that runs in a round groove and climbs its flanks. Without friction along the axle s, which the
/// slip around it takes away, the string lies where the groove's bottom is square to its pull b: the contact
/// is z = profile_radius (b.s) / |b| along the axle, as far as the groove is wide. From there it pulls: the
/// strands begin z s from the centre, and the torque is z s x force, which yaws and tilts the axle where
/// GyroscopicTilt has its gain. At the groove's edge the string rubs on the cup and brakes the spin by
/// flank_brake |force along the axle| / m, with the force of the step before.
template <class Scalar>
struct Groove : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "groove";
  static constexpr std::array kLaws{NamedLaw{"groove",
                                             "a string that climbs the groove's flanks",
                                             "axle",
                                             {"groove_profile"},
                                             {},
                                             "profile_radius"}};
  Scalar profile_radius{0};  ///< of the groove's bottom, in a cut along the axle [m]
  Scalar half_width{0};      ///< how far the string may climb [m]
  Scalar flank_brake{0};     ///< friction times radius of the rubbing times mass over axial inertia [1/m]

  bool neutral() const { return is_constant_zero(profile_radius) || is_constant_zero(half_width); }

  /// Where the string lies along the axle [m], from the diabolo's centre, under such a pull.
  Scalar climb(const Vector3<Scalar>& axis, const Vector3<Scalar>& pull) const {
    const Scalar climbed = profile_radius * dot<Scalar>(axis, pull) / maximum(norm(pull), Scalar(0.02));
    return maximum(Scalar(-half_width), minimum(half_width, climbed));
  }

  TipShift<Scalar> tip_shift(const State<Scalar>& state, const Tips<Scalar>& tips,
                             const Parameters<Scalar>&) const {
    const Mask<Scalar> captured = !is(state.string_state, StringState::kFlying);
    if (!any(captured)) return {};
    const Scalar away = climb(state.axis, StringPath<Scalar>(state.position, tips).gradient());
    const Vector3<Scalar> shift = state.axis * select(captured, away, Scalar(0));
    return {shift, shift};
  }

  Scalar spin_acceleration(const Scalar& spin, const State<Scalar>& state, const Tips<Scalar>&,
                           const Scalar& dt, const Parameters<Scalar>&) const {
    if (is_constant_zero(flank_brake)) return Scalar(0);
    const Scalar along = absolute<Scalar>(dot<Scalar>(state.axis, state.string_acceleration));
    const Mask<Scalar> at_edge =
        (half_width > Scalar(0)) && (profile_radius * along > half_width * norm(state.string_acceleration));
    const Scalar rest = absolute<Scalar>(spin) / dt;  // what stops it
    const Scalar braked = select(at_edge, minimum(Scalar(flank_brake * along), rest), Scalar(0));
    return select(spin > Scalar(0), Scalar(-braked), braked);
  }

  Vector3<Scalar> axle_torque(const State<Scalar>& state, const Tips<Scalar>& tips,
                              const StringStepResult<Scalar>& result, const Scalar& pull_difference,
                              const Parameters<Scalar>& parameters) const {
    const Scalar z = climb(state.axis, result.string_acceleration);
    return cross<Scalar>(state.axis, force_of_string(tips, result, pull_difference)) *
           Scalar(z / parameters.axle_radius);
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"profile_radius",
                        "m",
                        0.0,
                        1.0,
                        "of the groove's bottom, in a cut along the axle",
                        {"groove_profile", 1e-3, 0.0, 0.0, 0.05}},
          self.profile_radius);
    visit(ParameterInfo{"half_width", "m", 0.0, 0.1, "how far the string may climb from its middle"},
          self.half_width);
    visit(ParameterInfo{"flank_brake", "1/m", 0.0, 1e3,
                        "friction on the flank times its radius times mass over axial moment of inertia"},
          self.flank_brake);
  }
};

}  // namespace diabolo
