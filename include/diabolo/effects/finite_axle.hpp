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
/// sees a string of constant length from tips of a constant shift.
///
/// The axle counts as square to both strands, whatever the state's axis. With `follows_axis` it points along
/// that: the strands touch the circle around it, and their parts along it are left out where the angle is
/// counted.
template <class Scalar>
struct FiniteAxle : NeutralEffect<Scalar> {
  static constexpr std::string_view kName = "finite_axle";
  Scalar radius{0};        ///< of the axle and of the string's centre line around it [m]
  Scalar follows_axis{0};  ///< 1: the axle points along the state's axis; 0: square to both strands

  bool neutral() const { return is_constant_zero(radius); }

  TipShift<Scalar> tip_shift(const State<Scalar>& state, const Tips<Scalar>& tips,
                             const Parameters<Scalar>& parameters) const {
    const Mask<Scalar> captured = !is(state.string_state, StringState::kFlying);
    if (!any(captured)) return {};
    TipShift<Scalar> shifted;
    if (!all(follows())) shifted = square_to_strands(state, tips, parameters);
    if (any(follows())) {
      const TipShift<Scalar> around = around_axis(state, tips, parameters);
      shifted.left = select<Scalar>(follows(), around.left, shifted.left);
      shifted.right = select<Scalar>(follows(), around.right, shifted.right);
    }
    return {select<Scalar>(captured, shifted.left, TipShift<Scalar>().left),
            select<Scalar>(captured, shifted.right, TipShift<Scalar>().right)};
  }

  Scalar bound_length(const State<Scalar>& state, const Tips<Scalar>& shifted,
                      const Parameters<Scalar>& parameters) const {
    if (all(is(state.string_state, StringState::kFlying))) return Scalar(0);
    StringPath<Scalar> path(state.position, shifted);
    if (any(follows())) {
      path.from_left = select<Scalar>(follows(), beside(path.from_left, state.axis), path.from_left);
      path.from_right = select<Scalar>(follows(), beside(path.from_right, state.axis), path.from_right);
      path.left_length = norm(path.from_left);
      path.right_length = norm(path.from_right);
    }
    return select(is(state.string_state, StringState::kFlying), Scalar(0),
                  Scalar(radius * winding(state, path, parameters).angle));
  }

  /// Calls `visit(info, field)` for every field.
  template <class Self, class Visitor>
  static constexpr void for_each(Self& self, Visitor&& visit) {
    visit(ParameterInfo{"radius", "m", 0.0, 0.1, "of the axle, to the string's centre line"}, self.radius);
    visit(ParameterInfo{"follows_axis", "1", 0.0, 1.0,
                        "1: the axle points along the state's axis; 0: square to both strands"},
          self.follows_axis);
  }

 private:
  Mask<Scalar> follows() const { return follows_axis > Scalar(0.5); }

  TipShift<Scalar> square_to_strands(const State<Scalar>& state, const Tips<Scalar>& tips,
                                     const Parameters<Scalar>& parameters) const {
    const StringPath<Scalar> path(state.position, tips);
    const Vector3<Scalar> to_left = path.from_left * Scalar(Scalar(-1) / path.left_length),
                          to_right = path.from_right * Scalar(Scalar(-1) / path.right_length);
    // Strands that cross leave the axle on the other side of each other.
    const Vector3<Scalar> around = state.axis * side_of_axle(state, parameters);
    const bool turns = parameters.follow_turns;
    const Vector3<Scalar> left_in = turns ? cross<Scalar>(around, to_left) : across(to_left, to_right),
                          right_in = turns ? cross<Scalar>(to_right, around) : across(to_right, to_left);
    return {shift(to_left, left_in, path.left_length), shift(to_right, right_in, path.right_length)};
  }

  TipShift<Scalar> around_axis(const State<Scalar>& state, const Tips<Scalar>& tips,
                               const Parameters<Scalar>& parameters) const {
    const Vector3<Scalar> to_left = beside(tips.left - state.position, state.axis),
                          to_right = beside(tips.right - state.position, state.axis);
    const Vector3<Scalar> left = cross<Scalar>(state.axis, to_left),
                          right = cross<Scalar>(state.axis, to_right);
    const Scalar side = parameters.follow_turns
                            ? side_of_axle(state, parameters)
                            : select(dot<Scalar>(left, to_right) < Scalar(0), Scalar(-1), Scalar(1));
    return {shift(to_left * Scalar(Scalar(1) / norm(to_left)), left * side, norm(to_left)),
            shift(to_right * Scalar(Scalar(1) / norm(to_right)), right * Scalar(-side), norm(to_right))};
  }

  /// Without its part along the axle; never nothing.
  static Vector3<Scalar> beside(const Vector3<Scalar>& v, const Vector3<Scalar>& axis) {
    return v - axis * Scalar(dot<Scalar>(v, axis) * Scalar(1.0 - 1e-9));
  }

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
