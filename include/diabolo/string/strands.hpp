// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "diabolo/state.hpp"
#include "diabolo/sticks.hpp"

namespace diabolo {

/// The two straight strands of the string: unit vectors from the diabolo to the tips.
template <class Scalar>
struct Strands {
  Vector3<Scalar> left, right;

  /// In the middle of a step of the diabolo and of the tips.
  static Strands halfway(const State<Scalar>& before, const State<Scalar>& after, const Tips<Scalar>& begin,
                         const Tips<Scalar>& end) {
    const Scalar half(0.5);
    const Vector3<Scalar> middle = (before.position + after.position) * half;
    return {unit((begin.left + end.left) * half - middle), unit((begin.right + end.right) * half - middle)};
  }

  /// Left and right tension that add up to a pull, in its unit; none is negative. Strands on each other share
  /// it; those that are all but straight have as much as at an angle of 1e-3.
  std::pair<Scalar, Scalar> tensions(const Vector3<Scalar>& pull) const {
    const Scalar cosine = dot<Scalar>(left, right), square = Scalar(1) - cosine * cosine;
    const Scalar to_left = dot<Scalar>(left, pull), to_right = dot<Scalar>(right, pull);
    const Mask<Scalar> apart = square > Scalar(1e-6);
    const Scalar inverse = Scalar(1) / maximum(square, Scalar(1e-6));
    const Scalar each = select(cosine > Scalar(0), Scalar(0.5), Scalar(1000)) * norm(pull);
    return {select(apart, maximum(Scalar(0), Scalar((to_left - cosine * to_right) * inverse)), each),
            select(apart, maximum(Scalar(0), Scalar((to_right - cosine * to_left) * inverse)), each)};
  }

 private:
  static Vector3<Scalar> unit(const Vector3<Scalar>& v) { return v * Scalar(Scalar(1) / norm(v)); }
};

}  // namespace diabolo
