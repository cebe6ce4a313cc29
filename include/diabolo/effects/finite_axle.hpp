// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"
#include "diabolo/string/winding.hpp"

namespace diabolo {

/// An axle that is not thin: the strands leave it along its tangents, and `radius` times the contact angle of
/// the string, with all its wraps, lies around it. The strands pull as those to a thin axle would from tips
/// that are moved by the radius, square to each strand and towards the other. While the string swings, what
/// the strands lose is what the axle takes up (the strands' ends run along an involute), so that one step
/// sees a string of constant length from tips of a constant shift. For an axle square to both strands.
template <class Scalar>
struct FiniteAxle : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "finite_axle";
  Scalar radius{0};  ///< of the axle and of the string's centre line around it [m]

  bool neutral() const { return is_constant_zero(radius); }

  TipShift<Scalar> tip_shift(const State<Scalar>& state, const Tips<Scalar>& tips,
                             const Parameters<Scalar>& parameters) const {
    const StringPath<Scalar> path(state.position, tips);
    const Vector3<Scalar> to_left = path.from_left * Scalar(Scalar(-1) / path.left_length),
                          to_right = path.from_right * Scalar(Scalar(-1) / path.right_length);
    // Strands that cross leave the axle on the other side of each other.
    const Vector3<Scalar> around = state.axis * side_of_axle(state, parameters);
    const bool follows = parameters.follow_turns;
    const Vector3<Scalar> left_in = follows ? cross<Scalar>(around, to_left) : across(to_left, to_right),
                          right_in = follows ? cross<Scalar>(to_right, around) : across(to_right, to_left);
    const Mask<Scalar> captured = !is(state.string_state, StringState::kFlying);
    return {select<Scalar>(captured, shift(to_left, left_in, path.left_length), TipShift<Scalar>().left),
            select<Scalar>(captured, shift(to_right, right_in, path.right_length), TipShift<Scalar>().right)};
  }

  Scalar bound_length(const State<Scalar>& state, const Tips<Scalar>& shifted,
                      const Parameters<Scalar>& parameters) const {
    const StringPath<Scalar> path(state.position, shifted);
    return select(is(state.string_state, StringState::kFlying), Scalar(0),
                  Scalar(radius * winding(state, path, parameters).angle));
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"radius", "m", 0.0, 0.1, "of the axle, to the string's centre line"}, self.radius);
  }

 private:
  /// The part of the unit vector `other` that is square to `own`.
  static Vector3<Scalar> across(const Vector3<Scalar>& own, const Vector3<Scalar>& other) {
    return other - own * dot<Scalar>(other, own);
  }

  /// Of the tip that the unit vector `own` points to, `length` away; `in` is square to it.
  Vector3<Scalar> shift(const Vector3<Scalar>& own, const Vector3<Scalar>& in, const Scalar& length) const {
    const Vector3<Scalar> inward = in * Scalar(Scalar(1) / (norm(in) + Scalar(1e-9)));
    const Scalar sine = minimum(Scalar(radius / length), Scalar(1));  // a tip within the axle is on it
    const Scalar cosine = positive_sqrt<Scalar>(Scalar(1) - sine * sine);
    return inward * Scalar(radius * cosine) - own * Scalar(radius * sine);
  }
};

}  // namespace diabolo
