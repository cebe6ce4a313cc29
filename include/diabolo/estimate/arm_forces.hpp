// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "diabolo/estimate/measurements.hpp"
#include "diabolo/robot/arm/stick_arm.hpp"

namespace diabolo {

/// Torques that the string puts on an arm's joints: what they carry, less what arm, stick and motion need.
struct JointTorques {
  Joints<double> joints;  ///< where the joints are [rad]
  Joints<double> torque;  ///< [N m]
  double noise = 0.2;     ///< of each joint, a standard deviation [N m]
};

/// A tip's force by an arm's torques, world frame, and a factor of its covariance [N].
struct ArmForce {
  Vector3<double> force;
  MatrixOf<3> noise;
};

/// A force f on the tip turns the joints by J' f, J the tip's Jacobian: six torques, three unknowns, by least
/// squares. Where the tip cannot move in a direction, nothing is measured of it, and its noise is large.
/// Throws std::invalid_argument where a number is not finite, or the noise not positive.
inline ArmForce force_by_torques(const StickArm& arm, const JointTorques& read) {
  estimate_detail::expect_finite("joint torques, joints", read.joints.allFinite());
  estimate_detail::expect_finite("joint torques, torque", read.torque.allFinite());
  expect_positive("joint torques, noise", read.noise);
  constexpr double kUnobserved = 1e-9;  // [m^2]
  const PointJacobian<double> jacobian = arm.base.rotation * arm.chain.point_jacobian(read.joints, arm.tip);
  const Eigen::Matrix3d observed =
      jacobian * jacobian.transpose() + kUnobserved * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d inverse = observed.inverse();
  return {inverse * (jacobian * read.torque), read.noise * inverse.llt().matrixL().toDenseMatrix()};
}

/// Both tips' forces by the torques of two arms.
inline ForceMeasurement forces_by_torques(const StickArm& left_arm, const JointTorques& left,
                                          const StickArm& right_arm, const JointTorques& right) {
  const ArmForce on_left = force_by_torques(left_arm, left), on_right = force_by_torques(right_arm, right);
  return {{on_left.force, on_right.force}, on_left.noise, on_right.noise};
}

}  // namespace diabolo
