// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "diabolo/sticks.hpp"

namespace diabolo::python {

/// A tip motion beside what it was made from, which a motion of another Scalar (for derivatives) needs.
struct SampledTipMotion {
  std::vector<double> times;                 ///< [s]
  std::vector<Vector3<double>> left, right;  ///< [m]
  Interpolation interpolation;
  TipMotion<double> motion;

  SampledTipMotion(std::vector<double> instants, std::vector<Vector3<double>> left_tips,
                   std::vector<Vector3<double>> right_tips, Interpolation between)
      : times(std::move(instants)),
        left(std::move(left_tips)),
        right(std::move(right_tips)),
        interpolation(between),
        motion(times, left, right, interpolation) {}
};

}  // namespace diabolo::python
