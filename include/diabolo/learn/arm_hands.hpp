// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "diabolo/learn/hands.hpp"
#include "diabolo/robot/arm/joint_limits.hpp"
#include "diabolo/robot/arm/stick_map.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Where the tips of the paper's two UR5e may be under an agent: both in front of their arms, and as far
/// apart as the boxes of their seed grids are.
inline HandLimits arm_room() {
  HandLimits room;
  room.gap = 0.152;
  room.centre = {0.48, 0.0, 1.35};
  room.half = {0.02, 0.5, 0.25};
  return room;
}

namespace learn_detail {

/// The most that a joint turns for a tip whose coordinates all move: its rate over their speed [rad/m], and
/// its acceleration over the square of that [rad/m^2].
struct ArmGain {
  double rate = 0.0, bend = 0.0;
};

/// Sums of the sizes of a joint's slopes, the largest one: for a tip that moves as much along every axis.
inline Joints<double> slope_sums(const StickMap::Slopes& slopes) { return slopes.cwiseAbs().rowwise().sum(); }

/// Slopes at a point [m]. Throws std::invalid_argument where the arm does not bring its tip there.
inline StickMap::Slopes slopes_at(const StickMap& map, const Vector3<double>& point) {
  const StickMap::Point found = map.at(point);
  if (found.fault == StickFault::kNone) return found.slopes;
  std::string place;
  for (const double x : point) place += (place.empty() ? "" : ", ") + shown(x);
  throw std::invalid_argument("limits: the " + std::string(name_of(map.arm().side)) + " arm at (" + place +
                              ") m: " + text_of(found.fault) + "; expected a room that both arms reach");
}

/// Of each joint, the most in a tip's room, looked at on a grid.
inline std::array<ArmGain, kJointCount> gains_in(const StickMap& map, const HandLimits& room) {
  constexpr int kPoints = 9;       // along each axis
  constexpr double kAside = 1e-4;  // for the slopes' change [m]
  const std::size_t side = map.arm().side == Side::kLeft ? 0 : 1;
  std::array<ArmGain, kJointCount> gains{};
  Vector3<double> point;
  const auto look = [&] {
    const Joints<double> rates = slope_sums(slopes_at(map, point));
    Joints<double> bends = Joints<double>::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = room.room(side, axis);
      Vector3<double> before = point, after = point;
      before[axis] = std::max(low, point[axis] - kAside);
      after[axis] = std::min(high, point[axis] + kAside);
      const StickMap::Slopes change = slopes_at(map, after) - slopes_at(map, before);
      bends += slope_sums(change) / (after[axis] - before[axis]);
    }
    for (std::size_t i = 0; i < gains.size(); ++i) {
      gains[i].rate = std::max(gains[i].rate, rates[static_cast<Eigen::Index>(i)]);
      gains[i].bend = std::max(gains[i].bend, bends[static_cast<Eigen::Index>(i)]);
    }
  };
  const auto along = [&](int axis, const auto& inner) {
    const auto [low, high] = room.room(side, axis);
    for (int k = 0; k < kPoints; ++k) {
      point[axis] = low + (high - low) * k / (kPoints - 1);
      inner();
    }
  };
  along(0, [&] { along(1, [&] { along(2, look); }); });
  return gains;
}

}  // namespace learn_detail

/// Limits for an agent's hands under which no joint of two arms is faster, or accelerates more, than it may:
/// wherever in its part of `room` a tip is, and whichever way it goes. With the slopes S of an arm's map, the
/// joints' rate is S v and their acceleration S a + (v . grad S) v; half of what they may accelerate is for
/// each of these. They are bounds for all directions and places at once, of which 5 % are left for what lies
/// between the points that are looked at: in most places the arms could do more. The joints' jerk is not
/// among them, as an agent's accelerations jump from period to period.
/// Throws std::invalid_argument where an arm does not reach its part of the room.
inline HandLimits arm_hand_limits(const StickMap& left, const StickMap& right, const JointLimits& joints,
                                  const HandLimits& room = arm_room()) {
  constexpr double kUsed = 0.95, kForTurning = 0.5;
  check_limits(joints);
  room.validate();
  if (left.arm().side != Side::kLeft || right.arm().side != Side::kRight)
    throw std::invalid_argument("limits: expected the left arm, then the right one");
  HandLimits limits = room;
  limits.speed = limits.acceleration = 1e3;
  for (const StickMap* map : {&left, &right}) {
    const auto gains = learn_detail::gains_in(*map, room);
    for (std::size_t i = 0; i < gains.size(); ++i) {
      const double most = kUsed * joints.acceleration[i];
      limits.speed = std::min({limits.speed, kUsed * joints.speed[i] / gains[i].rate,
                               std::sqrt(kForTurning * most / gains[i].bend)});
      limits.acceleration = std::min(limits.acceleration, (1.0 - kForTurning) * most / gains[i].rate);
    }
  }
  return limits;
}

}  // namespace diabolo
