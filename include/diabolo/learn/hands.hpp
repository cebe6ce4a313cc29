// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "diabolo/sticks.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// The two tips, left before right.
struct Hands {
  using Pair = std::array<Vector3<double>, 2>;
  Pair position{Vector3<double>::Zero(), Vector3<double>::Zero()};  ///< [m]
  Pair velocity = position;                                         ///< [m/s]
};

/// What the tips may do under an agent. Each keeps to a box of its own: the left one to the left half of a
/// box around `centre`, the right one to the right half. Bounds are along an axis, those of TipLimits divided
/// by sqrt(3), so that none of them depends on another; only the string ties the two tips together.
struct HandLimits {
  double speed = 2.3;                      ///< along each axis [m/s]
  double acceleration = 34.6;              ///< along each axis [m/s^2]
  double gap = 0.02;                       ///< between the tips along y, at least [m]
  double string_margin = 0.002;            ///< the tips are closer than the string is long by this [m]
  Vector3<double> centre{0.0, 0.0, 1.25};  ///< of the box [m]
  Vector3<double> half{0.1, 0.72, 0.35};   ///< from its centre to its faces [m]

  /// Throws std::invalid_argument where a bound is out of its range.
  void validate() const {
    const auto positive = [](const char* name, double value) {
      if (!(value > 0.0 && value <= 1e3))
        throw std::invalid_argument(std::string("limits, ") + name + ": " + shown(value) +
                                    "; expected a positive number up to 1000");
    };
    positive("speed", speed);
    positive("acceleration", acceleration);
    for (const double side : half) positive("half", side);
    if (!(centre.cwiseAbs().maxCoeff() <= 1e3))
      throw std::invalid_argument("limits, centre: expected numbers from -1000 to 1000 m");
    if (!(gap >= 0.0 && gap < half.y()))
      throw std::invalid_argument("limits, gap: " + shown(gap) + " m; expected at least 0 and less than " +
                                  shown(half.y()) + " m, half the box's width");
    if (!(string_margin >= 0.0 && string_margin < 0.1))
      throw std::invalid_argument("limits, string_margin: " + shown(string_margin) +
                                  " m; expected at least 0 and less than 0.1 m");
  }

  /// The lowest and the highest place of a tip along an axis [m].
  std::pair<double, double> room(std::size_t side, int axis) const {
    const double middle = centre[axis];
    if (axis != 1) return {middle - half[axis], middle + half[axis]};
    return side == 0 ? std::pair(middle + 0.5 * gap, middle + half[1])
                     : std::pair(middle - half[1], middle - 0.5 * gap);
  }

  /// Whether a tip is within its room along an axis, not too fast, and has room to stop.
  bool allow(const Hands& hands, std::size_t side, int axis) const {
    constexpr double kSlack = 1e-9;
    const auto [low, high] = room(side, axis);
    const double place = hands.position[side][axis], speed_now = hands.velocity[side][axis];
    const double way = speed_now > 0.0 ? high - place : place - low;  // that is left to stop in
    return place >= low - kSlack && place <= high + kSlack && std::abs(speed_now) <= speed + kSlack &&
           speed_now * speed_now <= 2.0 * acceleration * way + kSlack;
  }

  bool allow(const Hands& hands) const {
    for (std::size_t side = 0; side < 2; ++side)
      for (int axis = 0; axis < 3; ++axis)
        if (!allow(hands, side, axis)) return false;
    return true;
  }

  /// Throws std::invalid_argument, which begins with `whose`, where hands are outside or too fast.
  void expect_within(const Hands& hands, const std::string& whose) const {
    for (std::size_t side = 0; side < 2; ++side)
      for (int axis = 0; axis < 3; ++axis)
        if (!allow(hands, side, axis))
          throw std::invalid_argument(whose + ": a tip at " + shown(hands.position[side][axis]) + " m with " +
                                      shown(hands.velocity[side][axis]) + " m/s along axis " +
                                      std::to_string(axis) +
                                      "; expected it within the limits, with room to stop");
  }
};

namespace learn_detail {

/// The speed at the end of a period, as near to `wanted` as a wall at `distance` ahead allows: what is left
/// of the way is enough to stop by `brake`, in whole periods too, since
///   x + (v + v') T / 2 + v'^2 / 2 b + v' T / 2 <= wall
/// holds again after a period of braking wherever it holds before.
inline double before_wall(double wanted, double speed, double distance, double period, double brake) {
  const double room = std::max(0.0, distance - 0.5 * speed * period);
  return std::min(wanted, brake * (std::sqrt(period * period + 2.0 * room / brake) - period));
}

/// The same speed, braked for a period.
inline double braked(double speed, double period, double brake) {
  return speed - std::clamp(speed, -brake * period, brake * period);
}

/// How far apart the tips may come to be at most [m], in the period that changes their velocities to `next`
/// and while they stop after it, each as fast as it can: from the corners of the boxes that hold their ways.
inline double farthest_apart(const Hands& hands, const Hands::Pair& next, const HandLimits& limits,
                             double period) {
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<std::pair<double, double>, 2> ways;
    for (std::size_t side = 0; side < 2; ++side) {
      const double x = hands.position[side][axis], v = hands.velocity[side][axis], u = next[side][axis];
      const double turns = x + 0.5 * v * period, end = turns + 0.5 * u * period;
      const double stops = end + 0.5 * u * period + 0.5 * u * std::abs(u) / limits.acceleration;
      ways[side] = std::minmax({x, turns, end, stops});
    }
    const auto& [left, right] = ways;
    const double apart = std::max(left.second - right.first, right.second - left.first);
    square += apart * apart;
  }
  return std::sqrt(square);
}

}  // namespace learn_detail

/// Moves the hands for a period [s] with constant accelerations, given as shares of what is allowed: left x,
/// y, z, right x, y, z; more than 1 counts as 1. Where a limit or the string, of `string_length` [m], is in
/// the way, they accelerate less or brake.
template <class Number>
void move_hands(Hands& hands, const Number* action, const HandLimits& limits, double string_length,
                double period) {
  Hands::Pair wanted, slower;
  const double brake = limits.acceleration;
  for (std::size_t side = 0; side < 2; ++side)
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = limits.room(side, axis);
      const double x = hands.position[side][axis], v = hands.velocity[side][axis];
      const double share = static_cast<double>(action[3 * static_cast<int>(side) + axis]);
      double next =
          std::clamp(v + brake * std::clamp(share, -1.0, 1.0) * period, -limits.speed, limits.speed);
      next = learn_detail::before_wall(next, v, high - x, period, brake);
      next = -learn_detail::before_wall(-next, -v, x - low, period, brake);
      wanted[side][axis] = next;
      slower[side][axis] = learn_detail::braked(v, period, brake);
    }
  const auto between = [&](double share) -> Hands::Pair {
    return {slower[0] + share * (wanted[0] - slower[0]), slower[1] + share * (wanted[1] - slower[1])};
  };
  // Braking is always possible: what it needs was seen to before. As much is done of the rest as is possible.
  Hands::Pair next = wanted;
  const double farthest = string_length - limits.string_margin;
  if (learn_detail::farthest_apart(hands, next, limits, period) > farthest) {
    double possible = 0.0;
    for (int halving = 1; halving <= 10; ++halving)
      if (const double more = possible + std::ldexp(1.0, -halving);
          learn_detail::farthest_apart(hands, between(more), limits, period) <= farthest)
        possible = more;
    next = between(possible);
  }
  for (std::size_t side = 0; side < 2; ++side) {
    hands.position[side] += 0.5 * period * (hands.velocity[side] + next[side]);
    hands.velocity[side] = next[side];
  }
}

/// The tips at `share` of a period [s] from `begin` to `end`.
inline Tips<double> tips_between(const Hands& begin, const Hands& end, double share, double period) {
  const auto position = [&](std::size_t side) -> Vector3<double> {
    const Vector3<double> gained = end.velocity[side] - begin.velocity[side];
    return begin.position[side] + period * share * (begin.velocity[side] + 0.5 * share * gained);
  };
  const auto velocity = [&](std::size_t side) -> Vector3<double> {
    return begin.velocity[side] + share * (end.velocity[side] - begin.velocity[side]);
  };
  Tips<double> tips;
  tips.left = position(0);
  tips.right = position(1);
  tips.left_velocity = velocity(0);
  tips.right_velocity = velocity(1);
  return tips;
}

}  // namespace diabolo
