// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>

#include "diabolo/math/small_solve.hpp"
#include "diabolo/robot/arm/chain.hpp"

namespace diabolo {

/// How close a refined solution must come: [m], and [rad] where an orientation is asked for.
template <class Scalar>
constexpr double refined_within() {
  return sizeof(ValueOf<Scalar>) >= sizeof(double) ? 5e-12 : 2e-6;
}

/// The farthest that one step turns a joint [rad]: near a singularity the slopes are not to be trusted.
inline constexpr double kLongestStep = 0.3;

/// Where Newton's method came to.
template <class Scalar>
struct Refined {
  Joints<Scalar> joints;   ///< [rad]; as good as it became
  double error = 0;        ///< largest component of what is left [m], [rad]
  int steps = 0;           ///< taken
  bool converged = false;  ///< error <= refined_within()
};

/// Joints of a chain near `seed` whose flange has the given pose, frame of the base: a solution of the
/// nominal arm becomes one of the calibrated arm. Reports where it does not come close; never throws.
template <class Scalar>
Refined<Scalar> refine_pose(const Chain<Scalar>& chain, const Pose<Scalar>& flange,
                            const Joints<Scalar>& seed, int most_steps = 6) {
  Refined<Scalar> result;
  result.joints = seed;
  bool slopes_lag = !std::floating_point<Scalar>;  // the derivatives are those of the step before
  for (;; ++result.steps) {
    const Pose<Scalar> now = chain.forward(result.joints);
    const Matrix3<Scalar> turn = flange.rotation * Matrix3<Scalar>(now.rotation.transpose());
    Eigen::Matrix<Scalar, 6, 1> step;
    step << flange.position - now.position, Scalar(0.5) * (turn(2, 1) - turn(1, 2)),
        Scalar(0.5) * (turn(0, 2) - turn(2, 0)), Scalar(0.5) * (turn(1, 0) - turn(0, 1));
    result.error = 0;
    for (int i = 0; i < 6; ++i) result.error = std::max(result.error, std::abs(plain(step[i])));
    // At half a turn the small-angle error vanishes too.
    const bool opposite = plain(turn(0, 0)) + plain(turn(1, 1)) + plain(turn(2, 2)) < 2.0;
    result.converged = result.error <= refined_within<Scalar>() && !opposite;
    if ((result.converged && !slopes_lag) || result.steps == most_steps || !std::isfinite(result.error))
      return result;
    if (!solve_in_place<Scalar, 6>(chain.jacobian(result.joints, Vector3<Scalar>::Constant(Scalar(0))), step))
      return result;
    slopes_lag = slopes_lag && !result.converged;
    double largest = 0;
    for (int i = 0; i < kJointCount; ++i) largest = std::max(largest, std::abs(plain(step[i])));
    const Scalar share = Scalar(largest > kLongestStep ? kLongestStep / largest : 1.0);
    for (int i = 0; i < kJointCount; ++i) result.joints[i] += share * step[i];
  }
}

}  // namespace diabolo
