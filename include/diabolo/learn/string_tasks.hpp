// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

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

struct SpinUpCircleTask {
  static constexpr TaskInfo kInfo{
      "SpinUpCircle",
      "lead the diabolo round in circles, and spin it up by them",
      "the change of the spin over 100 rad/s, and T / 10 s max(0, 1 - |w - g| / g) min(1, |v| / v_1) on the "
      "string, for a period T, a velocity v that turns w times a second and is v_1 on a circle of 5 cm at "
      "the "
      "goal g",
      10.0,
      {{{"rate", "1/s", 0.8, 1.6, "of the circles"}, {}}},
      0.0,
      20.0};

  static Worth judge(const Moment& m, Memory&) {
    const double gained = (m.after.spin - m.before.spin) / 100.0;
    if (m.after.string_state != StringState::kOnString) return {gained};
    const Vector3<double>&from = m.before.velocity, &to = m.after.velocity;
    const double turned =
        std::atan2(from.y() * to.z() - from.z() * to.y(), from.y() * to.y() + from.z() * to.z());
    const double full = 2.0 * std::numbers::pi, rate = std::abs(turned) / (full * m.period);
    const double size = std::hypot(to.y(), to.z()) / (full * m.goal[0] * 0.05);
    const double close = std::max(0.0, 1.0 - std::abs(rate - m.goal[0]) / m.goal[0]);
    return {gained + m.period / 10.0 * close * std::min(1.0, size)};
  }
};

}  // namespace diabolo
