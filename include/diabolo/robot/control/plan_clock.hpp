// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "diabolo/robot/arm/joint_limits.hpp"

namespace diabolo {

/// How fast a plan's time goes by: at 1 as planned; more slowly where a controller scales its speed down; and
/// down to standstill within the stop time, so that the arms brake along the plan's own path.
class PlanClock {
 public:
  explicit PlanClock(double stop_time) : stop_time_(stop_time) {}

  void start() { *this = PlanClock(stop_time_); }

  /// From now on down to standstill.
  void stop() {
    if (stopping_) return;
    stopping_ = true;
    from_ = rate_;
    stopping_for_ = 0;
  }

  /// Goes on by a tick at `scaling`, the slower arm's, within [0, 1]; returns the plan's time since start()
  /// in ticks.
  double advance(double scaling) {
    const double before = rate_;
    if (stopping_) {
      stopping_for_ += kTick;
      // No jump of the deceleration, and as little jerk as the smoother step has, but at once: after two
      // ticks an arm is as much slower as it is after five on that one.
      const double u = std::min(stopping_for_ / stop_time_, 1.0);
      rate_ = from_ * (1 - u * u * (3 - 2 * u));
    } else {
      // A critically damped filter: a change of the scaling takes some tenths of a second and no jump of
      // speed.
      const double pull = kFollow * kFollow * (std::clamp(scaling, 0.0, 1.0) - rate_) - 2 * kFollow * slope_;
      slope_ += pull * kTick;
      rate_ = std::clamp(rate_ + slope_ * kTick, 0.0, 1.0);
    }
    return ticks_ += 0.5 * (before + rate_);
  }

  double ticks() const { return ticks_; }
  double rate() const { return rate_; }
  bool stopping() const { return stopping_; }
  bool at_rest() const { return stopping_ && stopping_for_ >= stop_time_; }

 private:
  static constexpr double kFollow = 15.0;  // [1/s]

  double stop_time_, rate_ = 1, slope_ = 0, ticks_ = 0, from_ = 1, stopping_for_ = 0;
  bool stopping_ = false;
};

}  // namespace diabolo
