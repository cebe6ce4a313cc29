// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

#include "diabolo/string/string_step.hpp"

namespace diabolo {

/// Fraction of the step at which free motion makes the slack string taut. Newton's method within a bracket;
/// its last step carries the derivatives. Lanes outside `where` get 0.
template <class Scalar>
Scalar taut_fraction(const StringStep<Scalar>& step, const Mask<Scalar>& where) {
  // A hundredth of what the constraint is solved to, but never less than the path length can tell.
  const Scalar tolerance = Scalar(std::max(0.01 * constraint_tolerance<Scalar>(),
                                           4.0 * std::numeric_limits<ValueOf<Scalar>>::epsilon())) *
                           step.string_length;
  Scalar low{0}, high{1}, fraction{1};
  Mask<Scalar> settled{!where};
  for (int i = 0; i < 60; ++i) {
    const Scalar t = fraction * step.dt;
    const StringPath<Scalar> path(step.free_position(t), step.tips_at(fraction));
    const Scalar extension = path.length() - step.string_length;
    const Scalar slope = path.rate(step.free_velocity(t) * step.dt, step.end.left - step.begin.left,
                                   step.end.right - step.begin.right);
    low = select(extension < Scalar(0), fraction, low);
    high = select(extension < Scalar(0), high, fraction);
    const Scalar newton = fraction - extension / select(slope == Scalar(0), Scalar(1), slope);
    const Mask<Scalar> close = absolute<Scalar>(extension) <= tolerance;
    const Mask<Scalar> useful = close || ((newton >= low) && (newton <= high));
    const Scalar next = select(useful, newton, Scalar(Scalar(0.5) * (low + high)));
    fraction = select(settled, fraction, next);
    settled = settled || close;
    if (all(settled)) break;
  }
  return select(where, fraction, Scalar(0));
}

/// Velocity after the catch of a string that has just come taut, an impulse at both tips. Newton's law of
/// impact along the string: the outward rate of the path length becomes -restitution times what it was,
/// unless a resolved spring takes it up; of that rate what was `resting` takes its share. With resting tips
/// the kinetic energy loses (1 - restitution^2) rate^2 / (2 |gradient|^2), never less than nothing.
template <class Scalar>
Vector3<Scalar> velocity_after_catch(const StringStep<Scalar>& step, const Vector3<Scalar>& position,
                                     const Vector3<Scalar>& arriving, const Tips<Scalar>& tips) {
  const StringPath<Scalar> path(position, tips);
  const Vector3<Scalar> gradient = step.plane(path.gradient());
  const Scalar rate = path.rate(arriving, tips.left_velocity, tips.right_velocity);
  const Scalar square = squared_norm(gradient), resolution = step.resolution(square);
  const Scalar resting = step.beside(step.resting, square) * square;
  const Scalar lost =
      (Scalar(1) - resolution) * (Scalar(1) + step.restitution) + resting / (Scalar(1) + resting);
  return without_path_rate<Scalar>(arriving, gradient, maximum(rate, Scalar(0)) * lost);
}

}  // namespace diabolo
