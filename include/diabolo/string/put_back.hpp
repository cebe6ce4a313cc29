// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/string/string_step.hpp"

namespace diabolo {

/// The last resort where the iteration of the taut step finds nothing (violent tips, spheroids thinner than
/// the motion of a step): the diabolo goes back along the line to where it was, or to the tips' midpoint
/// where that is outside, until the string fits. With resting tips its speed is limited to what its energy
/// allows, so that none is gained.
template <class Scalar>
[[gnu::noinline]] void put_back(const StringStep<Scalar>& step, const Mask<Scalar>& where,
                                StringStepResult<Scalar>& result) {
  const Vector3<Scalar> outside = step.free_position(step.dt);
  const Vector3<Scalar> to_middle = (step.end.left + step.end.right) * Scalar(0.5) - step.position;
  const Scalar reach = step.string_length * Scalar(1.0 + constraint_tolerance<Scalar>());
  const Scalar begin_length = StringPath<Scalar>(step.position, step.end).length();
  const Mask<Scalar> was_inside = begin_length <= reach;
  const Vector3<Scalar> anchor =
      select<Scalar>(was_inside, step.position, Vector3<Scalar>(step.position + step.plane(to_middle)));
  // Not a bit longer than it was: what the string gives back is multiplied by its tension.
  const Scalar longest = select(was_inside, maximum(begin_length, step.string_length), step.string_length);
  Scalar low{0}, high{1};
  for (int i = 0; i < 60; ++i) {
    const Scalar middle = Scalar(0.5) * (low + high);
    const StringPath<Scalar> path(anchor + (outside - anchor) * middle, step.end);
    const Mask<Scalar> fits = path.length() <= longest;
    low = select(fits, middle, low);
    high = select(fits, high, middle);
  }
  const Vector3<Scalar> position = anchor + (outside - anchor) * low;
  const StringPath<Scalar> path(position, step.end);
  const Vector3<Scalar> gradient = step.plane(path.gradient());
  const Vector3<Scalar> arriving = step.free_velocity(step.dt);
  const Scalar rate = path.rate(arriving, step.end.left_velocity, step.end.right_velocity);
  const Vector3<Scalar> velocity = without_path_rate<Scalar>(arriving, gradient, rate);
  const Scalar allowed =
      squared_norm(arriving) + Scalar(2) * dot<Scalar>(step.acceleration, position - outside);
  const Scalar share = positive_sqrt<Scalar>(allowed / (squared_norm(velocity) + tiny<Scalar>()));
  const Scalar limit = select(was_inside, minimum(share, Scalar(1)), Scalar(1));
  result.position = select<Scalar>(where, position, result.position);
  result.velocity = select<Scalar>(where, Vector3<Scalar>(velocity * limit), result.velocity);
  result.slack = select(where, Scalar(step.string_length - path.length()), result.slack);
  result.gradient_squared = select(where, squared_norm(gradient), result.gradient_squared);
  const Scalar before = StringPath<Scalar>(step.position, step.begin).imbalance();
  result.passed = select(where, Scalar(Scalar(0.5) * (path.imbalance() - before)), result.passed);
  const Vector3<Scalar> pull = (velocity * limit - arriving) * Scalar(Scalar(1) / step.dt);
  result.tension = select(where, Scalar(norm<Scalar>(pull) / norm<Scalar>(gradient)), result.tension);
  result.string_acceleration = select<Scalar>(where, pull, result.string_acceleration);
}

}  // namespace diabolo
