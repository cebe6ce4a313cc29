// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "diabolo/robot/arm/inverse_near.hpp"
#include "servo_arm.hpp"

namespace stand_in {

/// A pose as URScript writes it: position [m] and rotation vector [rad], in the frame of the base.
using ToolPose = std::array<double, 6>;

inline diabolo::Pose<double> pose_of(const ToolPose& p) {
  diabolo::Pose<double> pose;
  const Eigen::Vector3d turn(p[3], p[4], p[5]);
  pose.position << p[0], p[1], p[2];
  if (turn.norm() > 0) pose.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  return pose;
}

inline ToolPose tool_pose(const diabolo::Pose<double>& pose) {
  const Eigen::AngleAxisd turn{Eigen::Matrix3d(pose.rotation)};
  const Eigen::Vector3d vector = turn.angle() * turn.axis();
  return {pose.position.x(), pose.position.y(), pose.position.z(), vector.x(), vector.y(), vector.z()};
}

/// Of the flange of an arm by the data sheet; the tool's offset is `tool`.
inline ToolPose forward(const JointVector& joints, const ToolPose& tool) {
  static const diabolo::Chain<double> chain = diabolo::ur5e_nominal<double>();
  return tool_pose(chain.forward(joints) * pose_of(tool));
}

/// The joints nearest to `near` that bring the tool to a pose; nothing where there are none.
inline std::optional<JointVector> backward(const ToolPose& pose, const ToolPose& tool,
                                           const JointVector& near) {
  static const diabolo::Chain<double> chain = diabolo::ur5e_nominal<double>();
  const diabolo::Refined<double> found =
      diabolo::inverse_near(chain, pose_of(pose) * pose_of(tool).inverse(), near);
  if (!found.converged) return {};
  return found.joints;
}

}  // namespace stand_in
