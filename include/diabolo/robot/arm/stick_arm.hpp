// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

#include "diabolo/robot/arm/stick_task.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Which of the player's two arms.
enum class Side { kLeft, kRight };

inline const char* name_of(Side side) { return side == Side::kLeft ? "left" : "right"; }

/// An arm where it stands, with the stick in its flange and the way it holds it.
struct StickArm {
  Side side = Side::kRight;
  Pose<double> base;                             ///< of the controller's base frame, in the world
  Chain<double> chain = ur5e_nominal<double>();  ///< nominal or calibrated
  Ur5eLengths lengths;                           ///< of the nominal arm nearest to it
  Vector3<double> tip;                           ///< of the stick, in the flange's frame [m]
  JointRanges ranges;                            ///< that the arm keeps to [rad]
  double pitch = 0;          ///< goal of q2 + q3 + q4 [rad]: the first wrist link horizontal
  double level = 0;          ///< height at which the stick's goal is level, q5 = pi [m, world]
  double wrist_2_slope = 0;  ///< of q5's goal over the height [rad/m]: the stick points where the tip goes

  /// The posture to hold with the tip at a point [m, world].
  Posture<double> goal(const Vector3<double>& point) const {
    return {pitch, kPi + wrist_2_slope * (point.z() - level), 0.0};
  }
  Vector3<double> to_base(const Vector3<double>& point) const { return base.inverse() * point; }
  /// Where the tip is [m, world].
  Vector3<double> tip_at(const Joints<double>& joints) const { return base * (chain.forward(joints) * tip); }
};

/// How the two arms are mounted: bases at one height, on a line along y, the right one at negative y.
struct Mounts {
  double height = 0.70;   ///< [m]; paper, section IV-C
  double spacing = 1.10;  ///< between the bases [m]; paper, section IV-C
  double forward = 0.0;   ///< x of the bases [m]
};

/// One of the paper's arms. The stick's place in the flange, the joint ranges and the goals of the posture
/// are those of the authors' program; the level height is theirs over the base. Throws
/// std::invalid_argument that names the field where a mount is not finite, or the spacing not above zero.
inline StickArm paper_arm(Side side, const Mounts& mounts = {}) {
  if (!std::isfinite(mounts.height))
    throw std::invalid_argument("height: " + shown(mounts.height) + " m; must be finite");
  if (!std::isfinite(mounts.spacing) || !(mounts.spacing > 0))
    throw std::invalid_argument("spacing: " + shown(mounts.spacing) + " m; must be > 0");
  if (!std::isfinite(mounts.forward))
    throw std::invalid_argument("forward: " + shown(mounts.forward) + " m; must be finite");
  const bool right = side == Side::kRight;
  const double quarter = kPi / 2, half = kPi;
  const double eased = 0.35;  // [rad] that the stick may tilt beyond the vertical at the edge of reach
  StickArm arm;
  arm.side = side;
  // The right arm's controller frame looks backwards, the left one's forward.
  arm.base.rotation = rotation_z(right ? -1.0 : 1.0, 0.0);
  arm.base.position = {mounts.forward, (right ? -0.5 : 0.5) * mounts.spacing, mounts.height};
  arm.tip = right ? Vector3<double>(0.0055, -0.043, 0.356) : Vector3<double>(0.0035, -0.048, 0.355);
  arm.pitch = right ? -3 * quarter : -quarter;
  arm.level = mounts.height + 0.55;
  arm.wrist_2_slope = right ? half : -half;
  arm.ranges = right ? JointRanges{{quarter, -half, -half, -half, quarter - eased, -0.1},
                                   {3 * quarter, -quarter / 2, 0, 0, 3 * quarter + eased, 0.1}}
                     : JointRanges{{quarter, -half, 0, -half, quarter - eased, -0.1},
                                   {3 * quarter, 0, half, 0, 3 * quarter + eased, 0.1}};
  return arm;
}

}  // namespace diabolo
