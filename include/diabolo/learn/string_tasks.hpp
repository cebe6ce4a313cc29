// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "diabolo/learn/task.hpp"

namespace diabolo {

// Tasks that are played on the string.

struct HoldTask {
  static constexpr TaskInfo kInfo{
      "Hold",
      "keep the diabolo still at a place",
      "T exp(-(|p - g|^2 + (0.2 s)^2 |v|^2) / (0.1 m)^2), for a period T, place p, velocity v and goal g",
      5.0,
      {{{"y", "m", -0.2, 0.2, "of the place, from where the diabolo hung at first"},
        {"z", "m", -0.15, 0.15, "of the place, from where the diabolo hung at first"}}}};

  static Worth judge(const Moment& m, Memory&) {
    const Vector3<double> wanted = m.rest + Vector3<double>(0.0, m.goal[0], m.goal[1]);
    const double off =
        (m.after.position - wanted).squaredNorm() + std::pow(0.2, 2) * m.after.velocity.squaredNorm();
    return {m.period * std::exp(-off / std::pow(0.1, 2))};
  }
};

struct SwingTask {
  static constexpr TaskInfo kInfo{
      "Swing",
      "swing the diabolo from side to side",
      "T max(0, 1 - |e - h| / h), for a period T, a goal h and e = v_y^2 / 2 g + y^2 / 2 l on the string, "
      "where y and l "
      "are how far the diabolo is beside the middle of the tips and below it",
      8.0,
      {{{"height", "m", 0.05, 0.25, "to which the swing would lift a pendulum"}, {}}}};

  static Worth judge(const Moment& m, Memory&) {
    if (m.after.string_state != StringState::kOnString) return {};
    const Vector3<double> from = m.after.position - 0.5 * (m.hands.position[0] + m.hands.position[1]);
    const double below = std::max(-from.z(), 0.05), along = m.after.velocity.y();
    const double height = along * along / (2.0 * m.gravity) + from.y() * from.y() / (2.0 * below);
    return {m.period * std::max(0.0, 1.0 - std::abs(height - m.goal[0]) / m.goal[0])};
  }
};

struct SpinUpTask {
  static constexpr TaskInfo kInfo{
      "SpinUp", "spin the diabolo up", "the change of the spin over 100 rad/s", 10.0, {}, 0.0, 20.0};

  static Worth judge(const Moment& m, Memory&) { return {(m.after.spin - m.before.spin) / 100.0}; }
};

}  // namespace diabolo
