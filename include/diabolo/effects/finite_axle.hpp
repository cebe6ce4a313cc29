// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "diabolo/effects/effect.hpp"
#include "diabolo/math/pairs.hpp"
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
    const Scalar held = select(captured, Scalar(1), Scalar(0));
    return {shifted.left * held, shifted.right * held};
  }

  Scalar bound_length(const State<Scalar>& state, const Tips<Scalar>& shifted,
                      const Parameters<Scalar>& parameters) const {
    if (all(is(state.string_state, StringState::kFlying))) return Scalar(0);
    return select(
        is(state.string_state, StringState::kFlying), Scalar(0),
        Scalar(radius * touched_angle(state, StringPath<Scalar>(state.position, shifted), parameters)));
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

  /// Over which the string lies around the axle [rad], with all its wraps.
  Scalar touched_angle(const State<Scalar>& state, const StringPath<Scalar>& path,
                       const Parameters<Scalar>& parameters) const {
    if (parameters.follow_turns || !any(follows())) return winding(state, path, parameters).angle;
    const Scalar around = contact_angle(path, state.axis) + wrapped_angle(parameters);
    return all(follows()) ? around : select(follows(), around, winding(state, path, parameters).angle);
  }

  TipShift<Scalar> square_to_strands(const State<Scalar>& state, const Tips<Scalar>& tips,
                                     const Parameters<Scalar>& parameters) const {
    const StringPath<Scalar> path(state.position, tips);
    const auto [from_left, from_right] = path.directions();
    // Strands that cross leave the axle on the other side of each other.
    const Vector3<Scalar> around = state.axis * side_of_axle(state, parameters);
    const bool turns = parameters.follow_turns;
    const Vector3<Scalar> left = turns ? cross<Scalar>(from_left, around) : across(from_left, -from_right),
                          right = turns ? cross<Scalar>(around, from_right) : across(from_right, -from_left);
    const auto [left_size, right_size] = norms<Scalar>(left, right);
    return tangents(path.from_left, left * Scalar(path.left_length / (left_size + Scalar(1e-9))),
                    path.from_right, right * Scalar(path.right_length / (right_size + Scalar(1e-9))));
  }

  TipShift<Scalar> around_axis(const State<Scalar>& state, const Tips<Scalar>& tips,
                               const Parameters<Scalar>& parameters) const {
    const StringPath<Scalar> path(state.position, tips);
    const Vector3<Scalar> from_left = across(state.axis, path.from_left),
                          from_right = across(state.axis, path.from_right);
    const Vector3<Scalar> left = cross<Scalar>(from_left, state.axis),
                          right = cross<Scalar>(from_right, state.axis);
    const Scalar side = parameters.follow_turns
                            ? side_of_axle(state, parameters)
                            : select(dot<Scalar>(left, from_right) > Scalar(0), Scalar(-1), Scalar(1));
    return tangents(from_left, left * side, from_right, right * Scalar(-side));
  }

  /// Without its part along a unit vector.
  static Vector3<Scalar> across(const Vector3<Scalar>& along, const Vector3<Scalar>& v) {
    return v - along * dot<Scalar>(v, along);
  }

  /// Of tips from which the axle is `left` and `right`; a strand leaves it on the side of its `in`, which is
  /// square to that and as long.
  TipShift<Scalar> tangents(const Vector3<Scalar>& left, const Vector3<Scalar>& left_in,
                            const Vector3<Scalar>& right, const Vector3<Scalar>& right_in) const {
    const Scalar square = radius * radius;
    // A tip within the axle is on it.
    const Scalar left_square = maximum(squared_norm<Scalar>(left), square + tiny<Scalar>()),
                 right_square = maximum(squared_norm<Scalar>(right), square + tiny<Scalar>());
    const auto [left_strand, right_strand] =
        square_roots(Scalar(left_square - square), Scalar(right_square - square));
    const auto [by_left, by_right] = quotients(radius, radius, left_square, right_square);
    return {(left_in * left_strand + left * radius) * by_left,
            (right_in * right_strand + right * radius) * by_right};
  }
};

}  // namespace diabolo
