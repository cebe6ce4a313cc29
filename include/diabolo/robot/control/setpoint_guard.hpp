// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "diabolo/robot/arm/clearance.hpp"
#include "diabolo/robot/arm/ik_seed_grid.hpp"
#include "diabolo/robot/control/control_fault.hpp"

namespace diabolo {

/// What every setpoint must keep, whatever plan it comes from.
struct GuardOptions {
  double tracking = 0.25;     ///< [rad] between a setpoint and where the arm is: 0.15 and what its lag makes
  double clearance = 0.10;    ///< [m] between the arms when they have come to rest
  double stop_time = 0.3;     ///< [s] that coming to rest takes
  double string_length = 0;   ///< [m]; zero: the tips may be any distance apart
  double beyond_box = 0.005;  ///< [m] that a tip may be outside its box
  double excess = 1.02;       ///< of diabolo::excess(), over the limits
  double stopping_excess = 1.8;  ///< the same while the arms stop: that is worth more than a smooth motion
};

/// Looks at each setpoint before it is sent.
class SetpointGuard {
 public:
  SetpointGuard(const StickArm& left, const GridBox& left_box, const StickArm& right,
                const GridBox& right_box, const JointLimits& limits, const GuardOptions& options)
      : arms_{left, right}, boxes_{left_box, right_box}, limits_(limits), options_(options) {}

  const GuardOptions& options() const { return options_; }

  /// The arms stand still at these joints: what is sent next is measured from here.
  void begin(const PairJoints& joints) {
    sent_.fill(joints);
    last_clearance_ = clearance(arms_[0], arms_[1], joints).distance;
  }

  /// The setpoint sent last [rad].
  const PairJoints& sent() const { return sent_[2]; }

  /// Whether the setpoint may be sent; where it may, counts it as sent. `actual` is where the arms are.
  ControlFault check(const PairJoints& setpoint, const PairJoints& actual, bool stopping) {
    for (const Side side : {Side::kLeft, Side::kRight})
      if (!all_finite<double>(half(setpoint, side))) return {ControlFaultKind::kNotFinite, side};
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const StickArm& arm = arms_[index(side)];
      const Joints<double> joints = half(setpoint, side);
      if (!arm.ranges.contain(joints)) return {ControlFaultKind::kRange, side};
      const Vector3<double> tip = arm.tip_at(joints), margin = Vector3<double>::Constant(options_.beyond_box);
      const GridBox& box = boxes_[index(side)];
      if (((tip + margin) - box.lower).minCoeff() < 0 || ((box.upper + margin) - tip).minCoeff() < 0)
        return {ControlFaultKind::kBox, side};
    }
    const double allowed = stopping ? options_.stopping_excess : options_.excess;
    if (!(excess(sent_[0], sent_[1], sent_[2], setpoint, limits_) <= allowed))
      return {ControlFaultKind::kStep, guilty(setpoint)};
    for (const Side side : {Side::kLeft, Side::kRight})
      if (!stopping &&
          !((half(setpoint, side) - half(actual, side)).cwiseAbs().maxCoeff() <= options_.tracking))
        return {ControlFaultKind::kTracking, side};
    const double between = clearance(arms_[0], arms_[1], setpoint).distance;
    const double closing = std::max(0.0, (last_clearance_ - between) / kTick);
    if (!stopping && !(between >= options_.clearance + 0.5 * closing * options_.stop_time))
      return {ControlFaultKind::kClearance, Side::kLeft};
    const Vector3<double> tips =
        arms_[0].tip_at(half(setpoint, Side::kLeft)) - arms_[1].tip_at(half(setpoint, Side::kRight));
    if (!stopping && options_.string_length > 0 && !(norm(tips) <= options_.string_length))
      return {ControlFaultKind::kString, Side::kLeft};
    sent_ = {sent_[1], sent_[2], setpoint};
    last_clearance_ = between;
    return {};
  }

  /// Whether one arm can go from `joints` to `goal` in a straight line of its joints while the other rests.
  bool way_is_clear(const PairJoints& joints, const PairJoints& goal, Side side) const {
    const Joints<double> from = half(joints, side), step = half(goal, side) - from;
    const int steps = static_cast<int>(std::ceil(step.cwiseAbs().maxCoeff() / 0.02)) + 1;
    PairJoints at = joints;
    if (!arms_[index(side)].ranges.contain<double>(half(goal, side))) return false;
    for (int i = 0; i <= steps; ++i) {
      const Joints<double> way = from + step * (static_cast<double>(i) / steps);
      if (side == Side::kLeft)
        at.head<kJointCount>() = way;
      else
        at.tail<kJointCount>() = way;
      if (!(clearance(arms_[0], arms_[1], at).distance >= options_.clearance)) return false;
    }
    return true;
  }

  static Joints<double> half(const PairJoints& joints, Side side) {
    return side == Side::kLeft ? joints.head<kJointCount>() : joints.tail<kJointCount>();
  }

 private:
  static std::size_t index(Side side) { return side == Side::kLeft ? 0 : 1; }

  /// The arm whose joints step farthest from where their speed would take them.
  Side guilty(const PairJoints& setpoint) const {
    const PairJoints step = setpoint - 2 * sent_[2] + sent_[1];
    return step.head<kJointCount>().cwiseAbs().maxCoeff() >= step.tail<kJointCount>().cwiseAbs().maxCoeff()
               ? Side::kLeft
               : Side::kRight;
  }

  std::array<StickArm, 2> arms_;
  std::array<GridBox, 2> boxes_;
  JointLimits limits_;
  GuardOptions options_;
  std::array<PairJoints, 3> sent_;  ///< the last three, oldest first
  double last_clearance_ = 0;       ///< [m] of the one sent last
};

}  // namespace diabolo
