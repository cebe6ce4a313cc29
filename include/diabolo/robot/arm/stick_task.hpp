// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "diabolo/robot/arm/arm_plane.hpp"
#include "diabolo/robot/arm/chain.hpp"
#include "diabolo/robot/arm/refine_inverse.hpp"
#include "diabolo/robot/arm/ur5e.hpp"

namespace diabolo {

/// How an arm holds its stick beyond where the tip is: the paper's three posture terms (section III-D). With
/// them six joints have six conditions, and the joints are a function of the tip's position.
template <class Scalar>
struct Posture {
  Scalar pitch = Scalar(0);    ///< q2 + q3 + q4 [rad]: of the first wrist link in the arm's plane
  Scalar wrist_2 = Scalar(0);  ///< q5 [rad]: lifts and lowers the stick
  Scalar wrist_3 = Scalar(0);  ///< q6 [rad]: zero, "not turned"
};

template <class Scalar>
Posture<Scalar> posture_of(const Joints<Scalar>& q) {
  return {q[1] + q[2] + q[3], q[4], q[5]};
}

/// A way to bring the tip to a point in a posture.
template <class Scalar>
struct StickSolution {
  Joints<Scalar> joints;                                   ///< [rad]
  int branch = 0;                                          ///< 2 * shoulder + elbow, each 0 or 1
  bool shoulder_singular = false, elbow_singular = false;  ///< as in InverseSolution
};

/// At most four ways; zero where the posture does not reach the point, or a number is not finite.
template <class Scalar>
struct StickSolutions {
  std::array<StickSolution<Scalar>, 4> all;
  int count = 0;

  const StickSolution<Scalar>* begin() const { return all.data(); }
  const StickSolution<Scalar>* end() const { return all.data() + count; }
};

/// Every joint vector that brings `tip`, a point of the flange [m], to `target` [m, frame of the base] in the
/// given posture, on an arm of those lengths. q5 and q6 are the posture's own.
template <class Scalar>
StickSolutions<Scalar> stick_inverse(const Vector3<Scalar>& target, const Vector3<Scalar>& tip,
                                     const Posture<Scalar>& posture, const Ur5eLengths& lengths = {}) {
  using std::cos;
  using std::sin;
  StickSolutions<Scalar> result;
  // From the wrist's plane to the tip: in the arm's plane along the wrist link and across it, and beside it.
  const Scalar c5 = cos(posture.wrist_2), s5 = sin(posture.wrist_2);
  const Scalar c6 = cos(posture.wrist_3), s6 = sin(posture.wrist_3);
  const Scalar u = tip.x() * c6 - tip.y() * s6, v = tip.x() * s6 + tip.y() * c6;
  const Scalar w = tip.z() + Scalar(lengths.d6);
  const Scalar link = u * c5 - w * s5, beside = u * s5 + w * c5 + Scalar(lengths.d4);
  const Scalar across = Scalar(lengths.d5) - v;
  const Scalar cp = cos(posture.pitch), sp = sin(posture.pitch);
  const Scalar along = link * cp + across * sp, up = link * sp - across * cp;
  if (!is_finite(along) || !is_finite(up) || !is_finite(beside) || !is_finite(target.x()) ||
      !is_finite(target.y()) || !is_finite(target.z()))
    return result;
  const std::optional<ShoulderTurns<Scalar>> shoulders =
      turn_shoulder<Scalar>(target.x(), target.y(), beside);
  if (!shoulders) return result;
  for (std::size_t shoulder = 0; shoulder < 2; ++shoulder) {
    const std::optional<TwoLinks<Scalar>> links = reach_with_two_links<Scalar>(
        lengths.a2, lengths.a3, shoulders->along[shoulder] - along, target.z() - Scalar(lengths.d1) - up);
    if (!links) continue;
    for (std::size_t elbow = 0; elbow < 2; ++elbow) {
      StickSolution<Scalar>& solution = result.all[static_cast<std::size_t>(result.count++)];
      solution.joints << shoulders->turn[shoulder], links->lift[elbow], links->bend[elbow],
          posture.pitch - links->lift[elbow] - links->bend[elbow], posture.wrist_2, posture.wrist_3;
      solution.branch = static_cast<int>(2 * shoulder + elbow);
      solution.shoulder_singular = plain(shoulders->along[0]) < kSingular;
      solution.elbow_singular = plain(links->sine_of_bend) < kSingular;
    }
  }
  return result;
}

/// The solution that differs least from the seed in its largest joint; the pitch keeps its turn. Nothing
/// where there is none.
template <class Scalar>
std::optional<StickSolution<Scalar>> nearest_solution(const StickSolutions<Scalar>& solutions,
                                                      const Joints<Scalar>& seed) {
  std::optional<StickSolution<Scalar>> best;
  double smallest = std::numeric_limits<double>::infinity();
  for (StickSolution<Scalar> solution : solutions) {
    double largest = 0;
    for (int i = 0; i < kJointCount; ++i) {
      solution.joints[i] = nearest_turn(solution.joints[i], plain(seed[i]));
      largest = std::max(largest, std::abs(plain(solution.joints[i]) - plain(seed[i])));
    }
    if (!(largest < smallest)) continue;
    smallest = largest;
    best = solution;
  }
  return best;
}

/// Joints of any chain near `seed` that bring the tip to the target while pitch, q5 and q6 stay as the seed
/// has them: Newton's method on q1, q2 and q3, q4 giving way.
template <class Scalar>
Refined<Scalar> refine_tip(const Chain<Scalar>& chain, const Vector3<Scalar>& target,
                           const Vector3<Scalar>& tip, const Joints<Scalar>& seed, int most_steps = 6) {
  Refined<Scalar> result;
  result.joints = seed;
  bool slopes_lag = !std::floating_point<Scalar>;  // the derivatives are those of the step before
  for (;; ++result.steps) {
    Vector3<Scalar> step = target - chain.forward(result.joints) * tip;
    result.error = 0;
    for (int i = 0; i < 3; ++i) result.error = std::max(result.error, std::abs(plain(step[i])));
    result.converged = result.error <= refined_within<Scalar>();
    if ((result.converged && !slopes_lag) || result.steps == most_steps || !std::isfinite(result.error))
      return result;
    slopes_lag = slopes_lag && !result.converged;
    const PointJacobian<Scalar> by_joint = chain.point_jacobian(result.joints, tip);
    Matrix3<Scalar> slopes;
    slopes << by_joint.col(0), by_joint.col(1) - by_joint.col(3), by_joint.col(2) - by_joint.col(3);
    if (!solve_in_place<Scalar, 3>(slopes, step)) return result;
    result.joints[0] += step[0];
    result.joints[1] += step[1];
    result.joints[2] += step[2];
    result.joints[3] -= step[1] + step[2];
  }
}

}  // namespace diabolo
