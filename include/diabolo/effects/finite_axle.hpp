// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"
#include "diabolo/string/string_path.hpp"

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
                             const Parameters<Scalar>&) const {
    const Mask<Scalar> captured = !is(state.string_state, StringState::kFlying);
    if (!any(captured)) return {};
    TipShift<Scalar> shifted;
    if (!all(follows())) {
      const StringPath<Scalar> path(state.position, tips);
      const Vector3<Scalar> to_left = path.from_left * Scalar(Scalar(-1) / path.left_length),
                            to_right = path.from_right * Scalar(Scalar(-1) / path.right_length);
      shifted = {shift(to_left, to_right, path.left_length), shift(to_right, to_left, path.right_length)};
    }
    if (any(follows())) {
      const Vector3<Scalar> left = across(state.position - tips.left, state.axis),
                            right = across(state.position - tips.right, state.axis);
      shifted.left = select<Scalar>(follows(), shift_around(state.axis, left, right), shifted.left);
      shifted.right = select<Scalar>(follows(), shift_around(state.axis, right, left), shifted.right);
    }
    return {select<Scalar>(captured, shifted.left, TipShift<Scalar>().left),
            select<Scalar>(captured, shifted.right, TipShift<Scalar>().right)};
  }

  Scalar bound_length(const State<Scalar>& state, const Tips<Scalar>& shifted,
                      const Parameters<Scalar>& parameters) const {
    if (all(is(state.string_state, StringState::kFlying))) return Scalar(0);
    StringPath<Scalar> path(state.position, shifted);
    if (any(follows())) {
      path.from_left = select<Scalar>(follows(), across(path.from_left, state.axis), path.from_left);
      path.from_right = select<Scalar>(follows(), across(path.from_right, state.axis), path.from_right);
      path.left_length = norm(path.from_left);
      path.right_length = norm(path.from_right);
    }
    return select(is(state.string_state, StringState::kFlying), Scalar(0),
                  Scalar(radius * (contact_angle(path) + wrapped_angle(parameters))));
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

  /// Without its part along the axle; never nothing.
  static Vector3<Scalar> across(const Vector3<Scalar>& v, const Vector3<Scalar>& axis) {
    return v - axis * Scalar(dot<Scalar>(v, axis) * Scalar(1.0 - 1e-9));
  }

  /// Of the tip from which the axle is seen at `own`, square to it; from the other tip at `other`.
  Vector3<Scalar> shift_around(const Vector3<Scalar>& axis, const Vector3<Scalar>& own,
                               const Vector3<Scalar>& other) const {
    const Scalar away = Scalar(1) / norm(own);
    const Vector3<Scalar> square = cross<Scalar>(axis, own) * away;
    const Scalar side = select(dot<Scalar>(square, other) > Scalar(0), Scalar(-radius), radius);
    const Scalar sine = minimum(Scalar(radius * away), Scalar(1));  // a tip within the axle is on it
    const Scalar cosine = positive_sqrt<Scalar>(Scalar(1) - sine * sine);
    return square * Scalar(side * cosine) + own * Scalar(radius * sine * away);
  }

  /// Of the tip that the unit vector `own` points to, `length` away.
  Vector3<Scalar> shift(const Vector3<Scalar>& own, const Vector3<Scalar>& other,
                        const Scalar& length) const {
    const Vector3<Scalar> across = other - own * dot<Scalar>(other, own);
    const Vector3<Scalar> inward = across * Scalar(Scalar(1) / (norm(across) + Scalar(1e-9)));
    const Scalar sine = minimum(Scalar(radius / length), Scalar(1));  // a tip within the axle is on it
    const Scalar cosine = positive_sqrt<Scalar>(Scalar(1) - sine * sine);
    return inward * Scalar(radius * cosine) - own * Scalar(radius * sine);
  }
};

}  // namespace diabolo
