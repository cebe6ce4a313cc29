// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diabolo/learn/task.hpp"
#include "diabolo/plan/axle_response.hpp"

namespace diabolo {

struct LevelTask {
  static constexpr TaskInfo kInfo{
      "Level",
      "bring the tilted axle level and straight ahead, and keep it there",
      "T / (1 + (t^2 + y^2) / (5 deg)^2) on the string, for a period T, a tilt t of the axle and a yaw y",
      8.0,
      {},
      60.0,
      100.0,
      true};
  static constexpr double kLevel = std::numbers::pi / 36.0;  ///< of the tilt and of the yaw [rad]

  /// The axle 3 to 20 degrees from level and ahead, in any direction.
  static void prepare(Beginning& begin) {
    const double off = begin.draw.uniform(3.0, 20.0) * std::numbers::pi / 180.0;
    const double direction = begin.draw.uniform(0.0, 2.0 * std::numbers::pi);
    begin.state.axis = axle_at({off * std::sin(direction), off * std::cos(direction)});
  }

  static Worth judge(const Moment& m, Memory& memory) {
    const auto [tilt, yaw] = axle_angles(m.after.axis);
    const bool held = m.after.string_state == StringState::kOnString;
    const bool level = held && std::max(std::abs(tilt), std::abs(yaw)) < kLevel;
    memory.level = level ? memory.level + m.period : 0.0;
    return {held ? m.period / (1.0 + (tilt * tilt + yaw * yaw) / (kLevel * kLevel)) : 0.0};
  }
};

}  // namespace diabolo
