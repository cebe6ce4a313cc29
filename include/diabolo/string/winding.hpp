// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <numbers>

#include "diabolo/parameters.hpp"
#include "diabolo/state.hpp"
#include "diabolo/string/string_path.hpp"

namespace diabolo {

/// How the string lies around the axle.
template <class Scalar>
struct Winding {
  Scalar angle;    ///< over which it touches the axle [rad], all turns counted, >= 0
  Scalar side{1};  ///< -1 where it runs around the axle the other way, so that the spin drags it to the left
};

/// Sine and cosine, times the lengths of both strands, of the angle by which the string turns at the diabolo:
/// seen along the axle, from the direction in which it comes from the left tip to that in which it leaves, in
/// the sense of a positive spin. Between 0 and pi under hands side by side.
template <class Scalar>
std::array<Scalar, 2> turn_at_axle(const StringPath<Scalar>& path, const Vector3<Scalar>& axis) {
  return {dot<Scalar>(axis, cross<Scalar>(path.from_left, path.from_right)),
          dot<Scalar>(axis, path.from_left) * dot<Scalar>(axis, path.from_right) -
              dot<Scalar>(path.from_left, path.from_right)};
}

/// Angle over which the string lies around a thin axle, seen along it; its sense does not count.
template <class Scalar>
Scalar contact_angle(const StringPath<Scalar>& path, const Vector3<Scalar>& axis) {
  using std::atan2;
  const auto [sine, cosine] = turn_at_axle(path, axis);
  return atan2(absolute(sine), Scalar(cosine + Scalar(1e-18)));
}

/// 1 or -1: the sense in which the string of Parameters::follow_turns runs around the axle, as last counted.
template <class Scalar>
Scalar side_of_axle(const State<Scalar>& state, const Parameters<Scalar>& parameters) {
  if (!parameters.follow_turns) return Scalar(1);
  return select(parameters.wraps + state.turns < Scalar(0), Scalar(-1), Scalar(1));
}

/// The angle of turn_at_axle() with all whole turns and its sign [rad]: of those that the strands may stand
/// for, that nearest to what was last counted. It grows past pi where the strands cross and past 2 pi where
/// they are straight again; then another turn is on. Negative where the string runs around the other way.
template <class Scalar>
Scalar wound_angle(const State<Scalar>& state, const StringPath<Scalar>& path,
                   const Parameters<Scalar>& parameters) {
  using std::atan2;
  using std::cos;
  using std::sin;
  const Scalar last = Scalar(2.0 * std::numbers::pi) * (parameters.wraps + state.turns);
  const auto [sine, cosine] = turn_at_axle(path, state.axis);
  const Scalar last_sine = sin(last), last_cosine = cos(last);
  // No direction at all, where the diabolo is at a tip, is no change.
  return last + atan2(Scalar(sine * last_cosine - cosine * last_sine),
                      Scalar(cosine * last_cosine + sine * last_sine + Scalar(1e-18)));
}

/// Without Parameters::follow_turns: the angle between the strands, and its `wraps`.
template <class Scalar>
Winding<Scalar> winding(const State<Scalar>& state, const StringPath<Scalar>& path,
                        const Parameters<Scalar>& parameters) {
  if (!parameters.follow_turns) return {contact_angle(path) + wrapped_angle(parameters)};
  const Scalar angle = wound_angle(state, path, parameters);
  return {absolute(angle), select(angle < Scalar(0), Scalar(-1), Scalar(1))};
}

/// Whether the string goes around the axle, so that it keeps it when slack.
template <class Scalar>
Mask<Scalar> is_wound(const State<Scalar>& state, const Tips<Scalar>& tips,
                      const Parameters<Scalar>& parameters) {
  if (!parameters.follow_turns) return !(parameters.wraps < Scalar(0.5));
  return winding(state, StringPath<Scalar>(state.position, tips), parameters).angle >=
         Scalar(std::numbers::pi);
}

}  // namespace diabolo
