// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>

#include "diabolo/robot/arm/inverse.hpp"
#include "diabolo/robot/arm/refine_inverse.hpp"

namespace diabolo {

/// Joints of any chain that is nearly the nominal arm, a calibrated one above all, whose flange has the given
/// pose, frame of the base: the nominal arm's solutions, nearest to `seed` first, each taken further by
/// refine_pose until one arrives within the ranges. Where none does, the last try, not converged, with the
/// seed's joints where there was none.
template <class Scalar>
Refined<Scalar> inverse_near(const Chain<Scalar>& chain, const Pose<Scalar>& flange,
                             const Joints<Scalar>& seed, const JointRanges& ranges = kUr5eRanges,
                             const Ur5eLengths& lengths = {}) {
  constexpr double kSlack = 0.05;  // a calibrated arm reaches some millimetres further, or less far
  struct Try {
    Joints<Scalar> joints;
    double distance;
  };
  std::array<Try, 8> tries;  // the first `count`, nearest first
  std::size_t count = 0;
  for (const InverseSolution<Scalar>& solution : inverse(flange, seed[5], lengths, kSlack)) {
    Try next{solution.joints, 0.0};
    if (!unwrap(next.joints, seed, ranges)) continue;
    for (int i = 0; i < kJointCount; ++i)
      next.distance = std::max(next.distance, std::abs(plain(next.joints[i]) - plain(seed[i])));
    std::size_t place = count++;
    for (; place > 0 && tries[place - 1].distance > next.distance; --place) tries[place] = tries[place - 1];
    tries[place] = next;
  }
  Refined<Scalar> result;
  result.joints = seed;
  for (std::size_t i = 0; i < count; ++i) {
    result = refine_pose(chain, flange, tries[i].joints);
    result.converged = result.converged && ranges.contain(result.joints);
    if (result.converged) break;
  }
  return result;
}

}  // namespace diabolo
