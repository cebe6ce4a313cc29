// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "diabolo/learn/task.hpp"

namespace diabolo {

// Tasks in which the diabolo leaves the string.

namespace learn_detail {

/// How high the diabolo is or would fly as it moves now, above the box's centre [m].
inline double apex_of(const State<double>& state, const Moment& m) {
  const double upward = std::max(0.0, state.velocity.z());
  return state.position.z() - m.centre.z() + upward * upward / (2.0 * m.gravity);
}

/// How far it has come towards an apex: 0 at rest, 1 there, less beyond.
inline double progress_to(double apex, const Moment& m) {
  const double from_rest = m.rest.z() - m.centre.z();
  return std::max(0.0, 1.0 - std::abs(apex_of(m.after, m) - apex) / (apex - from_rest));
}

/// Keeps the memory of flights; whether one has just ended in a catch. What is shorter than a tenth of a
/// second is none.
inline bool caught_now(const Moment& m, Memory& memory) {
  constexpr double kShortest = 0.1;
  const bool flies = m.after.string_state == StringState::kFlying;
  const double height = m.after.position.z() - m.centre.z();
  if (flies) {
    memory.apex = memory.flying ? std::max(memory.apex, height) : height;
    memory.aloft = memory.flying ? memory.aloft + m.period : m.period;
  }
  const bool caught = memory.flying && !flies && memory.aloft > kShortest;
  memory.flying = flies;
  memory.caught = caught ? 0.0 : memory.caught + m.period;
  if (caught) ++memory.flights;
  return caught;
}

/// The change of a potential while the diabolo is on the string; in flight it stays what it was.
inline double shaped(const Moment& m, Memory& memory, double apex) {
  if (m.after.string_state == StringState::kFlying) return 0.0;
  const double progress = progress_to(apex, m);
  const std::optional<double> last = std::exchange(memory.progress, progress);
  return progress - last.value_or(progress);
}

inline double close_to(double difference, double width) { return std::exp(-std::pow(difference / width, 2)); }

}  // namespace learn_detail

struct HopTask {
  static constexpr TaskInfo kInfo{
      "Hop",
      "let the diabolo hop off the string and catch it, again and again",
      "exp(-((a - h) / 0.1 m)^2) for each catch after a flight with apex a, and the change of q on the "
      "string, where q "
      "goes from 0 at rest to 1 where the diabolo would fly up to the goal h, and falls again beyond",
      6.0,
      {{{"height", "m", 0.1, 0.2, "of the apex above the middle of the tips' box"}, {}}}};

  static Worth judge(const Moment& m, Memory& memory) {
    using learn_detail::caught_now, learn_detail::close_to, learn_detail::shaped;
    const double change = shaped(m, memory, m.goal[0]);
    return {change + (caught_now(m, memory) ? close_to(memory.apex - m.goal[0], 0.1) : 0.0)};
  }
};

struct ThrowTask {
  static constexpr TaskInfo kInfo{
      "Throw",
      "throw the diabolo to a height",
      "the change of q on the string, where q goes from 0 at rest to 1 where the diabolo would fly up to the "
      "goal h, and falls again beyond; then 2 exp(-((a - h) / 0.1 m)^2) at the apex a, where the episode "
      "ends",
      4.0,
      {{{"height", "m", 0.3, 0.8, "of the apex above the middle of the tips' box"}, {}}}};

  static Worth judge(const Moment& m, Memory& memory) {
    using learn_detail::caught_now, learn_detail::close_to, learn_detail::shaped;
    const double change = shaped(m, memory, m.goal[0]);
    caught_now(m, memory);
    const bool turned = memory.flying && m.before.velocity.z() > 0.0 && m.after.velocity.z() <= 0.0;
    if (!turned || memory.apex < 0.0) return {change};
    return {2.0 * close_to(memory.apex - m.goal[0], 0.1), true};
  }
};

struct ThrowAndCatchTask {
  static constexpr TaskInfo kInfo{
      "ThrowAndCatch",
      "throw the diabolo to a height and catch it at a place",
      "the change of q on the string before the throw, where q goes from 0 at rest to 1 where the diabolo "
      "would fly up "
      "to the goal h, and falls again beyond; then for the catch 1 + exp(-((a - h) / 0.1 m)^2) "
      "exp(-((y - g) / 0.2 m)^2), for an apex a and a catch at y; the episode ends half a second later",
      4.0,
      {{{"height", "m", 0.3, 0.8, "of the apex above the middle of the tips' box"},
        {"y", "m", -0.3, 0.3, "of the catch, from the middle of the tips' box"}}}};

  static Worth judge(const Moment& m, Memory& memory) {
    using learn_detail::caught_now, learn_detail::close_to, learn_detail::shaped;
    constexpr double kKept = 0.5;  // [s]
    const bool thrown = memory.flights > 0, caught = caught_now(m, memory);
    if (thrown) return {0.0, memory.caught >= kKept};
    if (!caught) return {shaped(m, memory, m.goal[0])};
    const double beside = m.after.position.y() - m.centre.y() - m.goal[1];
    return {1.0 + close_to(memory.apex - m.goal[0], 0.1) * close_to(beside, 0.2)};
  }
};

}  // namespace diabolo
