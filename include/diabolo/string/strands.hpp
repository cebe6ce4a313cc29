// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <utility>

#include "diabolo/state.hpp"
#include "diabolo/sticks.hpp"

namespace diabolo {

/// The two straight strands of the string: unit vectors from the diabolo to the tips.
struct Strands {
  Vector3<double> left, right;

  /// In the middle of a step of the diabolo and of the tips.
  static Strands halfway(const State<double>& before, const State<double>& after, const Tips<double>& begin,
                         const Tips<double>& end) {
    const Vector3<double> middle = 0.5 * (before.position + after.position);
    return {(0.5 * (begin.left + end.left) - middle).normalized(),
            (0.5 * (begin.right + end.right) - middle).normalized()};
  }

  /// Left and right tension that add up to a pull, in its unit; none is negative. Strands on each other share
  /// it; those that are all but straight have as much as at an angle of 1e-3.
  std::pair<double, double> tensions(const Vector3<double>& pull) const {
    const double cosine = left.dot(right), square = 1.0 - cosine * cosine;
    if (!(square > 1e-6)) {
      const double each = (cosine > 0.0 ? 0.5 : 1000.0) * pull.norm();
      return {each, each};
    }
    const double to_left = left.dot(pull), to_right = right.dot(pull);
    return {std::max(0.0, (to_left - cosine * to_right) / square),
            std::max(0.0, (to_right - cosine * to_left) / square)};
  }
};

}  // namespace diabolo
