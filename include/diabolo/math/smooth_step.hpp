// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace diabolo {

/// From 0 at u <= 0 to 1 at u >= 1, its first two derivatives zero at both ends.
inline double smooth_step(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10 + u * (6 * u - 15));
}

/// The integral of smooth_step from 0 to u; 1/2 at u = 1.
inline double smooth_ramp(double u) {
  const double v = std::clamp(u, 0.0, 1.0);
  return v * v * v * v * (2.5 + v * (v - 3)) + (u > 1 ? u - 1 : 0);
}

}  // namespace diabolo
