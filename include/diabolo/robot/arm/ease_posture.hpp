// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "diabolo/robot/arm/stick_task.hpp"

namespace diabolo {

/// What it costs to leave a posture, per [rad^2]: the paper's "smaller cost" is that of wrist 2.
struct PostureCost {
  double pitch = 1.0, wrist_2 = 0.2, wrist_3 = 1.0;
  /// Of the elbow stretching further than `least_bend` [rad]: there a millimetre of the tip takes ever more
  /// of the elbow. Per square of the cosine's excess.
  double stretched = 0.0;
  double least_bend = 0.0;
};

/// Adds to the Gauss-Newton matrix what the curvature of the tip's way along the joints contributes under
/// `pull`: d2 tip / dqi dqj is axis i x (axis j x arm j) for i <= j.
template <class Scalar>
void add_curvature(const Chain<Scalar>& chain, const Joints<Scalar>& joints, const Vector3<Scalar>& tip,
                   const Vector3<Scalar>& pull, Eigen::Matrix<Scalar, 9, 9>& system) {
  const typename Chain<Scalar>::Links frames = chain.frames(joints);
  const PointJacobian<Scalar> slopes = chain.point_jacobian(joints, tip);
  for (int i = 0; i < kJointCount; ++i)
    for (int j = i; j < kJointCount; ++j) {
      const Vector3<Scalar> axis = frames[static_cast<std::size_t>(i)].rotation.col(2), slope = slopes.col(j);
      const Scalar curvature = dot(pull, cross(axis, slope));
      system(i, j) += curvature;
      if (i != j) system(j, i) += curvature;
    }
}

/// Joints near `seed` that bring the tip to `target` [m, frame of the base] and leave the posture as little
/// as that needs: equality-constrained Gauss-Newton, the tip exact, its curvature taken along (without it the
/// iteration runs in circles about a stretched elbow). Converged where the tip is met and a
/// further step moves no joint by more than 1e-9 rad (in float 1e-4).
template <class Scalar>
Refined<Scalar> ease_posture(const Chain<Scalar>& chain, const Vector3<Scalar>& target,
                             const Vector3<Scalar>& tip, const Posture<Scalar>& goal,
                             const Joints<Scalar>& seed, const PostureCost& cost = {}, int most_steps = 100) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const double at_rest = sizeof(ValueOf<Scalar>) >= sizeof(double) ? 1e-9 : 1e-4;
  Vector3<Scalar> pull = Vector3<Scalar>::Constant(Scalar(0));  // of the tip: the constraint's multipliers
  Refined<Scalar> result;
  result.joints = seed;
  double largest = 0;
  for (;; ++result.steps) {
    Joints<Scalar>& q = result.joints;
    const Vector3<Scalar> gap = target - chain.forward(q) * tip;
    result.error = 0;
    for (int i = 0; i < 3; ++i) result.error = std::max(result.error, std::abs(plain(gap[i])));
    result.converged = result.steps > 0 && largest <= at_rest && result.error <= refined_within<Scalar>();
    if (result.converged || result.steps == most_steps || !std::isfinite(result.error)) return result;
    // Rows: pitch, wrist 2, wrist 3, elbow; each with the root of its cost.
    const Posture<Scalar> now = posture_of(q);
    Eigen::Matrix<Scalar, 4, 6> slopes = Eigen::Matrix<Scalar, 4, 6>::Constant(Scalar(0));
    Eigen::Matrix<Scalar, 4, 1> residuals;
    const Scalar pitch = Scalar(std::sqrt(cost.pitch)), wrist_2 = Scalar(std::sqrt(cost.wrist_2)),
                 wrist_3 = Scalar(std::sqrt(cost.wrist_3)), stretched = Scalar(std::sqrt(cost.stretched));
    for (int i = 1; i < 4; ++i) slopes(0, i) = pitch;
    slopes(1, 4) = wrist_2;
    slopes(2, 5) = wrist_3;
    const Scalar excess = cos(q[2]) - Scalar(std::cos(cost.least_bend));
    const bool bends = plain(excess) <= 0;
    slopes(3, 2) = bends ? Scalar(0) : Scalar(-stretched * sin(q[2]));
    residuals << pitch * (now.pitch - goal.pitch), wrist_2 * (now.wrist_2 - goal.wrist_2),
        wrist_3 * (now.wrist_3 - goal.wrist_3), bends ? Scalar(0) : Scalar(stretched * excess);
    Eigen::Matrix<Scalar, 9, 9> system = Eigen::Matrix<Scalar, 9, 9>::Constant(Scalar(0));
    const PointJacobian<Scalar> by_joint = chain.point_jacobian(q, tip);
    system.template topLeftCorner<6, 6>() = slopes.transpose() * slopes;
    add_curvature(chain, q, tip, pull, system);
    for (int i = 0; i < kJointCount; ++i) system(i, i) += Scalar(0.1 * largest);
    system.template topRightCorner<6, 3>() = by_joint.transpose();
    system.template bottomLeftCorner<3, 6>() = by_joint;
    Eigen::Matrix<Scalar, 9, 1> step;
    step << -(slopes.transpose() * residuals), gap;
    if (!solve_in_place<Scalar, 9>(system, step)) return result;
    largest = 0;
    for (int i = 0; i < kJointCount; ++i) largest = std::max(largest, std::abs(plain(step[i])));
    pull = step.template tail<3>();
    const Scalar share = Scalar(largest > kLongestStep ? kLongestStep / largest : 1.0);
    for (int i = 0; i < kJointCount; ++i) q[i] += share * step[i];
  }
}

}  // namespace diabolo
