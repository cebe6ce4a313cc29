// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "diabolo/robot/arm/ik_seed_grid.hpp"
#include "diabolo/robot/arm/stick_arm.hpp"

namespace diabolo {

/// Why a point of the stick has no joints.
enum class StickFault {
  kNone,
  kOutside,     ///< of the grid's box, or not finite
  kOutOfReach,  ///< the arm does not reach the point in the grid's posture
  kRange,       ///< a joint would leave its range
};

inline const char* text_of(StickFault fault) {
  switch (fault) {
    case StickFault::kNone:
      return "reached";
    case StickFault::kOutside:
      return "outside the box of the seed grid";
    case StickFault::kOutOfReach:
      return "out of reach";
    case StickFault::kRange:
      return "a joint leaves its range";
  }
  return "";
}

/// The joints of an arm as a function of its stick's tip: the posture is that of the interpolated seed, the
/// tip is met exactly. No memory, so no drift: whatever the way there, a point has one joint vector.
class StickMap {
 public:
  using Slopes = IkSeedGrid::Slopes;
  struct Point {
    Joints<double> joints = Joints<double>::Zero();  ///< [rad]
    Slopes slopes = Slopes::Zero();                  ///< over the tip's position [rad/m]
    StickFault fault = StickFault::kNone;            ///< else the numbers mean nothing
  };

  StickMap(StickArm arm, IkSeedGrid grid) : arm_(std::move(arm)), grid_(std::move(grid)) {}

  const StickArm& arm() const { return arm_; }
  const IkSeedGrid& grid() const { return grid_; }

  /// Joints with the tip at a point [m, world]. Never throws or allocates.
  Point at(const Vector3<double>& point) const {
    Point result;
    result.fault = StickFault::kOutside;
    if (!grid_.box().contains(point)) return result;
    const IkSeedGrid::Seed seed = grid_.at(point);
    const Vector3<double> target = arm_.to_base(point);
    result.fault = StickFault::kOutOfReach;
    const std::optional<StickSolution<double>> nominal =
        nearest_solution(stick_inverse(target, arm_.tip, posture_of(seed.joints), arm_.lengths), seed.joints);
    if (!nominal) return result;
    const Refined<double> refined = refine_tip(arm_.chain, target, arm_.tip, nominal->joints);
    if (!refined.converged || !set_slopes(refined.joints, seed.slopes, result.slopes)) return result;
    result.joints = refined.joints;
    result.fault = arm_.ranges.contain(result.joints) ? StickFault::kNone : StickFault::kRange;
    return result;
  }

 private:
  /// How the joints follow the tip while q5, q6 and the pitch follow the seed.
  bool set_slopes(const Joints<double>& joints, const Slopes& seed, Slopes& slopes) const {
    const PointJacobian<double> by_joint = arm_.chain.point_jacobian(joints, arm_.tip);
    const Eigen::RowVector3d pitch = seed.row(1) + seed.row(2) + seed.row(3);
    Eigen::Matrix3d system;
    system << by_joint.col(0), by_joint.col(1) - by_joint.col(3), by_joint.col(2) - by_joint.col(3);
    const Eigen::Matrix3d turn = arm_.base.rotation.transpose();
    const Eigen::Matrix3d moved =
        turn - by_joint.col(3) * pitch - by_joint.col(4) * seed.row(4) - by_joint.col(5) * seed.row(5);
    for (int axis = 0; axis < 3; ++axis) {
      Vector3<double> turns = moved.col(axis);
      if (!solve_in_place<double, 3>(system, turns)) return false;
      slopes.col(axis) << turns, pitch[axis] - turns[1] - turns[2], seed(4, axis), seed(5, axis);
    }
    return true;
  }

  StickArm arm_;
  IkSeedGrid grid_;
};

}  // namespace diabolo
