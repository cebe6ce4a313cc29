// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "diabolo/robot/arm/joint_limits.hpp"
#include "diabolo/robot/arm/stick_arm.hpp"

namespace diabolo {

/// All points within `radius` of the line between two ends [m, world].
struct Capsule {
  Vector3<double> from, to;
  double radius = 0;
};

/// How far two capsules are apart [m]; negative where they overlap.
inline double distance(const Capsule& a, const Capsule& b) {
  const Vector3<double> along = a.to - a.from, other = b.to - b.from, between = a.from - b.from;
  const double aa = dot(along, along), bb = dot(other, other), ab = dot(along, other);
  const double ac = dot(along, between), bc = dot(other, between);
  // The nearest points of two lines, then of what the ends leave of them; a point is a line without length.
  const double cross_square = aa * bb - ab * ab;
  double s = cross_square > 1e-12 * aa * bb ? std::clamp((ab * bc - bb * ac) / cross_square, 0.0, 1.0) : 0.0;
  double t = bb > 0 ? std::clamp((ab * s + bc) / bb, 0.0, 1.0) : 0.0;
  s = aa > 0 ? std::clamp((ab * t - ac) / aa, 0.0, 1.0) : 0.0;
  const Vector3<double> gap = between + along * s - other * t;
  return norm(gap) - a.radius - b.radius;
}

/// What an arm's capsules are, from the base to the tip.
inline constexpr std::array<const char*, 9> kArmParts{"base",    "shoulder", "upper arm", "elbow", "forearm",
                                                      "wrist 1", "wrist 2",  "wrist 3",   "stick"};
using ArmShape = std::array<Capsule, kArmParts.size()>;

/// A UR5e with a stick in capsules, one of kArmParts each. Lengths are the arm's; the radii and the place of
/// the upper arm beside the shoulder's axis are ours, rounded up from the look of the arm: check them on
/// yours.
inline ArmShape shape_of(const StickArm& arm, const Joints<double>& joints) {
  constexpr double kUpperArmBeside = 0.138, kForearmBeside = 0.007;
  const Chain<double>::Links frames = arm.chain.frames(joints);
  const auto at = [&](std::size_t link, double x, double z) -> Vector3<double> {
    return arm.base * (frames[link] * Vector3<double>(x, 0, z));
  };
  const Vector3<double> shoulder = at(0, 0, 0), upper = at(1, 0, kUpperArmBeside),
                        bend = at(1, arm.lengths.a2, kUpperArmBeside), elbow = at(2, 0, kForearmBeside),
                        end = at(2, arm.lengths.a3, kForearmBeside), wrist_1 = at(3, 0, 0),
                        wrist_2 = at(4, 0, 0), flange = at(5, 0, 0);
  return {{{arm.base.position, shoulder, 0.09},
           {shoulder, upper, 0.08},
           {upper, bend, 0.075},
           {bend, elbow, 0.075},
           {elbow, end, 0.065},
           {end, wrist_1, 0.06},
           {wrist_1, wrist_2, 0.06},
           {wrist_2, flange, 0.055},
           {flange, arm.tip_at(joints), 0.02}}};
}

/// The two parts that are nearest to each other.
struct Clearance {
  double distance = 0;              ///< [m]; negative where they overlap
  std::size_t left = 0, right = 0;  ///< of kArmParts
};

/// Between the two arms, sticks included.
inline Clearance clearance(const StickArm& left, const StickArm& right, const PairJoints& joints) {
  const ArmShape a = shape_of(left, joints.head<kJointCount>()),
                 b = shape_of(right, joints.tail<kJointCount>());
  Clearance nearest{distance(a[0], b[0]), 0, 0};
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) {
      const double found = distance(a[i], b[k]);
      if (found < nearest.distance) nearest = {found, i, k};
    }
  return nearest;
}

}  // namespace diabolo
