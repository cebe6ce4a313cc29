// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "diabolo/learn/flight_tasks.hpp"
#include "diabolo/learn/task.hpp"

namespace diabolo {

// Tasks of several parts, one after the other.

struct PassTask {
  static constexpr TaskInfo kInfo{
      "Pass",
      "catch what comes from the left, and throw it on to the right",
      "1 for the catch; the change of q on the string after it, where q goes to 1 where the diabolo would "
      "come "
      "down at the goal g, and is 0 where it would not leave the box or not rise above its centre; "
      "then 2 exp(-((y - g) / 0.2 m)^2) where it comes down at y through the height of the box's centre, "
      "where the episode ends",
      4.0,
      {{{"y", "m", -1.6, -1.0, "of where it comes down, from the middle of the tips' box"}, {}}}};

  /// It comes flying, and would pass near the middle of the box after about half a second.
  static void prepare(Beginning& b) {
    const double time = b.draw.uniform(0.5, 0.7), away = b.draw.uniform(0.9, 1.2),
                 to = b.draw.uniform(-0.1, 0.1);
    b.state.position = b.centre + Vector3<double>(0.0, to + away, 0.0);
    b.state.velocity = {0.0, -away / time, 0.5 * b.gravity * time};
    b.state.string_state = StringState::kFlying;
    b.state.string_acceleration.setZero();
  }

  static Worth judge(const Moment& m, Memory& memory) {
    using learn_detail::caught_now, learn_detail::close_to;
    const bool caught = caught_now(m, memory);
    if (caught && memory.flights == 1) return {1.0};
    if (memory.flights < 1) return {};
    const double height = m.centre.z();
    const bool down = memory.flying && m.before.position.z() >= height && m.after.position.z() < height;
    if (down) return {2.0 * close_to(m.after.position.y() - m.centre.y() - m.goal[0], 0.2), true};
    if (memory.flying) return {};
    const double progress = progress_to(m);
    return {progress - std::exchange(memory.progress, progress).value_or(progress)};
  }

 private:
  static double progress_to(const Moment& m) {
    const double upward = m.after.velocity.z(), above = m.after.position.z() - m.centre.z();
    const double square = upward * upward + 2.0 * m.gravity * above;
    if (!(square > 0.0) || upward <= 0.0) return 0.0;
    const double time = (upward + std::sqrt(square)) / m.gravity;
    const double down = m.after.position.y() - m.centre.y() + m.after.velocity.y() * time;
    return std::max(0.0, 1.0 - std::abs(down - m.goal[0]) / std::abs(m.goal[0]));
  }
};

struct RoutineTask {
  static constexpr TaskInfo kInfo{
      "Routine",
      "spin the diabolo up, throw it, catch it and calm it",
      "the change of min(1, w / g) for a spin w, until it is the goal g; then what ThrowAndCatch gives with "
      "a catch in the middle; then, for two seconds, T exp(-(|v| / 0.3 m/s)^2) for a period T and a velocity "
      "v on the string",
      15.0,
      {{{"spin", "rad/s", 70.0, 100.0, "before the throw", kSpinSeenOver},
        {"height", "m", 0.3, 0.6, "of the apex above the middle of the tips' box"}}},
      30.0,
      50.0};

  static Worth judge(const Moment& m, Memory& memory) {
    using learn_detail::caught_now, learn_detail::close_to, learn_detail::shaped;
    const bool caught = caught_now(m, memory);
    if (memory.stage == 0) {
      if (m.after.spin >= m.goal[0]) memory.stage = 1;
      const auto share = [&](double spin) { return std::min(1.0, spin / m.goal[0]); };
      return {share(m.after.spin) - share(m.before.spin)};
    }
    if (memory.stage == 1) {
      if (!caught) return {shaped(m, memory, m.goal[1])};
      memory.stage = 2;
      const double beside = m.after.position.y() - m.centre.y();
      return {1.0 + close_to(memory.apex - m.goal[1], 0.1) * close_to(beside, 0.2)};
    }
    constexpr double kToCalm = 2.0;  // [s]
    const bool held = m.after.string_state == StringState::kOnString;
    return {held ? m.period * close_to(m.after.velocity.norm(), 0.3) : 0.0, memory.caught >= kToCalm};
  }
};

}  // namespace diabolo
