// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "diabolo/string/string_step.hpp"

namespace diabolo {

/// What rounding leaves of a path length [m]: about four epsilon of it.
template <class Scalar>
Scalar path_rounding(const StringStep<Scalar>& step) {
  return Scalar(4.0 * static_cast<double>(std::numeric_limits<ValueOf<Scalar>>::epsilon())) *
         step.string_length;
}

/// A step by `impulse` [m/s] along the discrete gradient between two paths of a rigid string gives exactly
/// tension times what the second path is shorter than the first: nothing, but for the tolerance and the
/// rounding of the lengths. Yet between tips all but a string apart, a tension of a million times the weight
/// holds a diabolo of some m/s, and a path is no more than a few epsilon of its length sure. Takes that
/// energy from the velocity in the lanes `where`; what tips do that move is not part of it.
///
/// The change of the length is the discrete gradient times the displacement (relative to the tips), which
/// keeps the digits that the difference of two lengths loses, and the displacement is the mean velocity: the
/// balance of kinetic energy holds to its own rounding.
template <class Scalar>
[[gnu::noinline]] void keep_energy(const StringStep<Scalar>& step, const StringPath<Scalar>& begin,
                                   const StringPath<Scalar>& end, const Scalar& impulse,
                                   const Mask<Scalar>& where, Vector3<Scalar>& velocity) {
  const Vector3<Scalar> left =
      (begin.from_left + end.from_left) * Scalar(Scalar(1) / (begin.left_length + end.left_length));
  const Vector3<Scalar> right =
      (begin.from_right + end.from_right) * Scalar(Scalar(1) / (begin.right_length + end.right_length));
  const Vector3<Scalar> direction = step.plane(left + right);
  const Vector3<Scalar> pulled = step.free_velocity(step.dt) - direction * impulse;
  const Scalar shortened = dot<Scalar>(left, step.end.left - step.begin.left) +
                           dot<Scalar>(right, step.end.right - step.begin.right) -
                           dot<Scalar>(direction, step.velocity + pulled) * Scalar(Scalar(0.5) * step.dt);
  const Scalar surplus = shortened * impulse / step.dt;
  const Mask<Scalar> gains = where && (surplus > energy_tolerance<Scalar>());
  const Scalar kept = Scalar(1) - Scalar(2) * surplus / (squared_norm(velocity) + tiny<Scalar>());
  velocity = velocity * select(gains, positive_sqrt<Scalar>(kept), Scalar(1));
}

}  // namespace diabolo
