// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/math/smooth_step.hpp"
#include "diabolo/robot/arm/joint_limits.hpp"
#include "diabolo/sticks.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Where both stick tips are [m, world].
struct TipPair {
  Vector3<double> left, right;
};

/// Of the tips, so that its ticks fit into memory [s].
inline constexpr double kLongestMotion = 3600.0;

/// Throws std::invalid_argument where a motion lasts longer than kLongestMotion.
inline void check_duration(const TipMotion<double>& motion) {
  if (const double duration = motion.end() - motion.begin(); !(duration <= kLongestMotion))
    throw std::invalid_argument("tip motion: lasts " + shown(duration) + " s; expected " +
                                shown(kLongestMotion) + " s at most");
}

/// The clock of a motion that is played between two of its times. For `rest` seconds it starts up from
/// standstill, where `from_rest`, and always runs down to it at the end: arms that get nothing new come to
/// rest on the motion's own curve. That takes half of `rest` longer at each of these ends.
struct RestClock {
  double from, to;        ///< times of the motion [s]
  double rest, starting;  ///< [s]; starting: zero or rest

  double duration() const { return to - from + 0.5 * (rest + starting); }  ///< [s]
  /// The motion's time after so much of play [s].
  double at(double time) const {
    const double left_over = duration() - time;
    if (left_over < rest) return to - rest * smooth_ramp(std::max(left_over, 0.0) / rest);
    if (time < starting) return from + starting * smooth_ramp(time / starting);
    return from + time - 0.5 * starting;
  }
};

/// A motion of the tips one tick apart, from its first instant to its last, by a RestClock. Throws
/// std::invalid_argument where the motion is shorter than that takes or longer than kLongestMotion, or the
/// times do not fit.
inline std::vector<TipPair> tips_to_rest(const TipMotion<double>& motion, double from, double rest,
                                         bool from_rest) {
  check_duration(motion);
  const double length = motion.end() - from;
  const double starting = from_rest ? rest : 0.0;
  if (!(rest > 0) || !std::isfinite(rest))
    throw std::invalid_argument("rest: " + shown(rest) + " s; must be finite and > 0");
  if (!(length >= 0.5 * (rest + starting)) || !(from >= motion.begin()))
    throw std::invalid_argument("tip motion: from " + shown(from) + " to " + shown(motion.end()) +
                                " s; must last " + shown(0.5 * (rest + starting)) +
                                " s or more, time to start and stop, and not begin before " +
                                shown(motion.begin()) + " s");
  const RestClock clock{from, motion.end(), rest, starting};
  std::vector<TipPair> path(static_cast<std::size_t>(std::ceil(clock.duration() / kTick - 1e-9)) + 1);
  std::size_t hint = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Tips<double> tips = motion.at(clock.at(static_cast<double>(i) * kTick), hint);
    path[i] = {tips.left, tips.right};
  }
  return path;
}

}  // namespace diabolo
