// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "diabolo/math/pack.hpp"
#include "diabolo/sticks.hpp"
#include "diabolo/text/expect_positive.hpp"
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
    expect_positive("limits, speed", speed, 1e3);
    expect_positive("limits, acceleration", acceleration, 1e3);
    for (const double side : half) expect_positive("limits, half", side, 1e3);
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

/// A number of the left tip and of the right one, in lanes.
using Both = Pack<double, 2>;

/// A number of both tips along each axis.
using BothTips = std::array<Both, 3>;

inline Both both(double left, double right) {
  Both pair;
  pair.set(0, left);
  pair.set(1, right);
  return pair;
}

inline BothTips both(const Hands::Pair& pair) {
  BothTips tips;
  for (int axis = 0; axis < 3; ++axis)
    tips[static_cast<std::size_t>(axis)] = both(pair[0][axis], pair[1][axis]);
  return tips;
}

inline Both clamped(const Both& x, double most) { return minimum(maximum(x, Both(-most)), Both(most)); }

/// The speed at the end of a period, as near to `wanted` as a wall at `distance` ahead allows: what is left
/// of the way is enough to stop by `brake`, in whole periods too, since
///   x + (v + v') T / 2 + v'^2 / 2 b + v' T / 2 <= wall
/// holds again after a period of braking wherever it holds before.
inline Both before_wall(const Both& wanted, const Both& speed, const Both& distance, double period,
                        double brake) {
  const Both room = maximum(Both(0), Both(distance - Both(0.5) * speed * Both(period)));
  return minimum(wanted, Both(Both(brake) *
                              (sqrt(Both(period * period) + Both(2) * room / Both(brake)) - Both(period))));
}

/// The speeds that the shares of the acceleration in `action` lead to, and the walls allow.
template <class Number>
BothTips wanted_speeds(const BothTips& place, const BothTips& speed, const Number* action,
                       const HandLimits& limits, double period) {
  BothTips wanted;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Both& v = speed[axis];
    const Both share =
        clamped(both(static_cast<double>(action[axis]), static_cast<double>(action[axis + 3])), 1.0);
    const Both free = clamped(v + Both(limits.acceleration) * share * Both(period), limits.speed);
    const auto [left_low, left_high] = limits.room(0, static_cast<int>(axis));
    const auto [right_low, right_high] = limits.room(1, static_cast<int>(axis));
    // Only the wall ahead can be in the way.
    const Both ahead = select(free > Both(0), Both(1), Both(-1));
    const Both wall = select(free > Both(0), both(left_high, right_high), both(left_low, right_low));
    wanted[axis] = ahead * before_wall(ahead * free, ahead * v, ahead * (wall - place[axis]), period,
                                       limits.acceleration);
  }
  return wanted;
}

/// How far apart the tips may come to be at most [m], in the period that changes their velocities to `next`
/// and while they stop after it, each as fast as it can: from the corners of the boxes that hold their ways.
inline double farthest_apart(const BothTips& place, const BothTips& speed, const BothTips& next,
                             const HandLimits& limits, double period) {
  double square = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Both &x = place[axis], &u = next[axis];
    const Both turns = x + Both(0.5) * speed[axis] * Both(period), end = turns + Both(0.5) * u * Both(period);
    const Both stops =
        end + Both(0.5) * u * Both(period) + Both(0.5) * u * absolute(u) / Both(limits.acceleration);
    const Both lowest = minimum(minimum(x, turns), minimum(end, stops)),
               highest = maximum(maximum(x, turns), maximum(end, stops));
    const double apart = std::max(highest[0] - lowest[1], highest[1] - lowest[0]);
    square += apart * apart;
  }
  return std::sqrt(square);
}

/// As much of `wanted` as the string, up to `farthest` [m], allows, and braking for the rest. Braking is
/// always possible: what it needs was seen to before.
inline BothTips within_string(const BothTips& place, const BothTips& speed, const BothTips& wanted,
                              const HandLimits& limits, double period, double farthest) {
  if (!(farthest_apart(place, speed, wanted, limits, period) > farthest)) return wanted;
  const auto between = [&](double share) {
    BothTips next;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Both slower = speed[axis] - clamped(speed[axis], limits.acceleration * period);
      next[axis] = slower + Both(share) * (wanted[axis] - slower);
    }
    return next;
  };
  double possible = 0.0;
  for (int halving = 1; halving <= 10; ++halving)
    if (const double more = possible + std::ldexp(1.0, -halving);
        farthest_apart(place, speed, between(more), limits, period) <= farthest)
      possible = more;
  return between(possible);
}

}  // namespace learn_detail

/// Moves the hands for a period [s] with constant accelerations, given as shares of what is allowed: left x,
/// y, z, right x, y, z; more than 1 counts as 1. Where a limit or the string, of `string_length` [m], is in
/// the way, they accelerate less or brake.
template <class Number>
void move_hands(Hands& hands, const Number* action, const HandLimits& limits, double string_length,
                double period) {
  const learn_detail::BothTips place = learn_detail::both(hands.position),
                               speed = learn_detail::both(hands.velocity);
  const learn_detail::BothTips next = learn_detail::within_string(
      place, speed, learn_detail::wanted_speeds(place, speed, action, limits, period), limits, period,
      string_length - limits.string_margin);
  for (int side = 0; side < 2; ++side)
    for (int axis = 0; axis < 3; ++axis) {
      double& velocity = hands.velocity[static_cast<std::size_t>(side)][axis];
      const double last = next[static_cast<std::size_t>(axis)][side];
      hands.position[static_cast<std::size_t>(side)][axis] += 0.5 * period * (velocity + last);
      velocity = last;
    }
}

/// The hands as tips, at a time [s].
inline Tips<double> tips_of(const Hands& hands, double time) {
  Tips<double> tips;
  tips.left = hands.position[0];
  tips.right = hands.position[1];
  tips.left_velocity = hands.velocity[0];
  tips.right_velocity = hands.velocity[1];
  tips.time = time;
  return tips;
}

/// The tips at `share` of a period [s] from `begin` to `end`.
inline Tips<double> tips_between(const Hands& begin, const Hands& end, double share, double period) {
  return tips_between(tips_of(begin, 0.0), tips_of(end, period), share, period);
}

}  // namespace diabolo
