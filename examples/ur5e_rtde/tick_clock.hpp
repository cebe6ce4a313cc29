// SPDX-License-Identifier: MIT
#pragma once

#include <time.h>

#include <cmath>

#include "diabolo/robot/arm/joint_limits.hpp"

namespace ur5e {

/// The control loop's clock: instants one tick apart, by absolute times so that nothing adds up. A tick that
/// was missed is left out, never made up for in a burst.
class TickClock {
 public:
  TickClock() : next_(now()) {}

  static double now() {
    timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  /// Sleeps until the next instant; returns the time then [s].
  double wait() {
    next_ += diabolo::kTick;
    if (const double late = now() - next_; late > 0)
      next_ += std::floor(late / diabolo::kTick) * diabolo::kTick;
    timespec time;
    time.tv_sec = static_cast<time_t>(next_);
    time.tv_nsec = static_cast<long>((next_ - std::floor(next_)) * 1e9);
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr);
    return now();
  }

 private:
  double next_;
};

}  // namespace ur5e
