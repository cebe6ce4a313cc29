// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/string_step.hpp"

namespace diabolo {

/// Where a diabolo comes that is moved from the end of a step by `move` [m], all but along the string: back
/// along the gradient of the path length, until the path is as long as before. Two steps of Newton's method;
/// the length is convex, so that they stay outside and never pass the point they look for.
template <class Scalar>
[[gnu::noinline]] Vector3<Scalar> slide_along_string(const StringStep<Scalar>& step,
                                                     const Vector3<Scalar>& from,
                                                     const Vector3<Scalar>& move) {
  const Scalar length = StringPath<Scalar>(from, step.end).length();
  Vector3<Scalar> position = from + move;
  for (int i = 0; i < 2; ++i) {
    const StringPath<Scalar> path(position, step.end);
    const Vector3<Scalar> gradient = step.plane(path.gradient());
    const Scalar beyond = path.length() - length;
    position = position - gradient * Scalar(beyond / (squared_norm(gradient) + Scalar(1e-12)));
  }
  return position;
}

}  // namespace diabolo
