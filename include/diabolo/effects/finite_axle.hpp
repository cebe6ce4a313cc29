// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"
#include "diabolo/string/string_path.hpp"

namespace diabolo {

/// An axle that is not thin: the strands leave it along its tangents, and `radius` times the contact angle of
/// the string, with all its wraps, lies around it. The strands pull as those to a thin axle would from tips
/// that are moved by the radius, square to the axle and to each strand and towards the other. While the
/// string swings, what the strands lose is what the axle takes up (the strands' ends run along an involute),
/// so that one step sees a string of constant length from tips of a constant shift.
template <class Scalar>
struct FiniteAxle : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "finite_axle";
  Scalar radius{0};  ///< of the axle and of the string's centre line around it [m]

  bool neutral() const { return is_constant_zero(radius); }

  TipShift<Scalar> tip_shift(const State<Scalar>& state, const Tips<Scalar>& tips,
                             const Parameters<Scalar>&) const {
    const Vector3<Scalar> to_left = across(tips.left - state.position, state.axis),
                          to_right = across(tips.right - state.position, state.axis);
    const Mask<Scalar> captured = !is(state.string_state, StringState::kFlying);
    return {select<Scalar>(captured, shift(to_left, to_right, state.axis), TipShift<Scalar>().left),
            select<Scalar>(captured, shift(to_right, to_left, state.axis), TipShift<Scalar>().right)};
  }

  Scalar bound_length(const State<Scalar>& state, const Tips<Scalar>& shifted,
                      const Parameters<Scalar>& parameters) const {
    StringPath<Scalar> path(state.position, shifted);  // as seen along the axle
    path.from_left = across(path.from_left, state.axis);
    path.from_right = across(path.from_right, state.axis);
    path.left_length = norm(path.from_left);
    path.right_length = norm(path.from_right);
    return select(is(state.string_state, StringState::kFlying), Scalar(0),
                  Scalar(radius * (contact_angle(path) + wrapped_angle(parameters))));
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"radius", "m", 0.0, 0.1, "of the axle, to the string's centre line"}, self.radius);
  }

 private:
  /// Without its part along the axle; never nothing.
  static Vector3<Scalar> across(const Vector3<Scalar>& v, const Vector3<Scalar>& axis) {
    return v - axis * Scalar(dot<Scalar>(v, axis) * Scalar(1.0 - 1e-9));
  }

  /// Of the tip that is at `own` from the axle, square to it; the other tip is at `other`.
  Vector3<Scalar> shift(const Vector3<Scalar>& own, const Vector3<Scalar>& other,
                        const Vector3<Scalar>& axis) const {
    const Scalar away = Scalar(1) / norm(own);
    const Vector3<Scalar> square = cross<Scalar>(axis, own) * away;
    const Scalar side = select(dot<Scalar>(square, other) < Scalar(0), Scalar(-radius), radius);
    const Scalar sine = minimum(Scalar(radius * away), Scalar(1));  // a tip within the axle is on it
    const Scalar cosine = positive_sqrt<Scalar>(Scalar(1) - sine * sine);
    return square * Scalar(side * cosine) - own * Scalar(radius * sine * away);
  }
};

}  // namespace diabolo
