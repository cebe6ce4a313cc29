// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "diabolo/robot/arm/joints.hpp"
#include "diabolo/robot/arm/pose.hpp"

namespace diabolo {

/// Velocity of a point over joint speeds: rows 0-2 [m/rad]; rows 3-5, where they are there, the rotation.
template <class Scalar>
using Jacobian = Eigen::Matrix<Scalar, 6, 6>;
template <class Scalar>
using PointJacobian = Eigen::Matrix<Scalar, 3, 6>;

/// Six rotating joints in a row, as URDF describes them: link i is moved and turned against link i - 1 by
/// `links[i]` and then turned about its own z axis by joint i. The last link is the flange.
template <class Scalar>
class Chain {
 public:
  using Links = std::array<Pose<Scalar>, kJointCount>;

  explicit Chain(const Links& links) : links_(links) {}

  const Links& links() const { return links_; }

  /// Pose of every link in the frame of the base; the last one is the flange.
  Links frames(const Joints<Scalar>& joints) const {
    Links frames;
    Pose<Scalar> frame;
    for (std::size_t i = 0; i < kJointCount; ++i) {
      advance(frame, i, joints);
      frames[i] = frame;
    }
    return frames;
  }

  /// Pose of the flange in the frame of the base.
  Pose<Scalar> forward(const Joints<Scalar>& joints) const {
    Pose<Scalar> frame;
    for (std::size_t i = 0; i < kJointCount; ++i) advance(frame, i, joints);
    return frame;
  }

  /// Velocity of `point` of the flange [m] and rotation of the flange, frame of the base.
  Jacobian<Scalar> jacobian(const Joints<Scalar>& joints, const Vector3<Scalar>& point) const {
    const Links all = frames(joints);
    const Vector3<Scalar> end = all[kJointCount - 1] * point;
    Jacobian<Scalar> result;
    for (std::size_t i = 0; i < kJointCount; ++i) {
      const Vector3<Scalar> axis = all[i].rotation.col(2), arm = end - all[i].position;
      result.col(static_cast<Eigen::Index>(i)) << cross(axis, arm), axis;
    }
    return result;
  }

  /// Its first three rows.
  PointJacobian<Scalar> point_jacobian(const Joints<Scalar>& joints, const Vector3<Scalar>& point) const {
    return jacobian(joints, point).template topRows<3>();
  }

 private:
  /// From link i - 1 to link i.
  void advance(Pose<Scalar>& frame, std::size_t i, const Joints<Scalar>& joints) const {
    using std::cos;
    using std::sin;
    const Scalar angle = joints[static_cast<Eigen::Index>(i)];
    const Scalar c = cos(angle), s = sin(angle);
    frame = frame * links_[i];
    const Vector3<Scalar> x = frame.rotation.col(0), y = frame.rotation.col(1);
    frame.rotation.col(0) = x * c + y * s;
    frame.rotation.col(1) = y * c - x * s;
  }

  Links links_;
};

}  // namespace diabolo
