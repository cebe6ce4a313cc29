// SPDX-License-Identifier: MIT
#pragma once

#include "geometry.hpp"

namespace plant {

/// A polynomial from 0 to 1 with least jerk: value and derivatives by its phase, which is kept within 0 to 1.
struct LeastJerk {
  double value = 0.0;
  double rate = 0.0;
  double second_rate = 0.0;

  explicit LeastJerk(double phase) {
    if (!(phase > 0.0)) return;
    if (phase >= 1.0) {
      value = 1.0;
      return;
    }
    value = phase * phase * phase * (10.0 + phase * (6.0 * phase - 15.0));
    rate = 30.0 * phase * phase * (1.0 - phase) * (1.0 - phase);
    second_rate = 60.0 * phase * (1.0 - phase) * (1.0 - 2.0 * phase);
  }
};

/// The hands reach aside and come back, or stay for good, on top of the motion that was planned.
struct Reach {
  double begin = 0.0;                              ///< [s]
  double there = 0.0;                              ///< [s]
  double leave = 0.0;                              ///< [s]
  double back = 0.0;                               ///< [s]
  Pair<Vec3> offsets{Vec3::Zero(), Vec3::Zero()};  ///< of the tips while there [m]

  /// Share of the offset at `time` [s], with its derivatives by time.
  LeastJerk share(double time) const {
    const bool out = time < leave;
    const double span = out ? there - begin : leave - back;
    LeastJerk share((time - (out ? begin : back)) / span);
    share.rate /= span;
    share.second_rate /= span * span;
    return share;
  }
};

}  // namespace plant
