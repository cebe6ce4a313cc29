// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/string/string_step.hpp"

namespace diabolo {

/// Where a diabolo comes that is moved from the end of a step by `move` [m], all but along the string: back
/// along the gradient of the path length, until the path is as long as before. Newton's method; the length is
/// convex, so that it stays outside and never passes the point it looks for. Two steps do, but for a thin
/// spheroid.
template <class Scalar>
[[gnu::noinline]] Vector3<Scalar> slide_along_string(const StringStep<Scalar>& step,
                                                     const Vector3<Scalar>& from,
                                                     const Vector3<Scalar>& move) {
  const Scalar length = StringPath<Scalar>(from, step.end).length();
  Vector3<Scalar> position = from + move;
  for (int i = 0; i < 12; ++i) {
    const StringPath<Scalar> path(position, step.end);
    const Vector3<Scalar> gradient = step.plane(path.gradient());
    // As the length is convex it is beyond by no more than this; rounding, by a straight string, may say so.
    const Scalar most = norm<Scalar>(gradient) * norm<Scalar>(move);
    const Scalar beyond = maximum(minimum(Scalar(path.length() - length), most), Scalar(-most));
    if (i > 1 && all(beyond <= step.tolerance())) break;
    position = position - gradient * Scalar(beyond / (squared_norm(gradient) + Scalar(1e-12)));
  }
  return position;
}

}  // namespace diabolo
