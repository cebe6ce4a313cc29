// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace plant {

/// Coulomb friction of a string that turns by `wrap` [rad] around an axle: the difference of its two tensions
/// is at most `coefficient` times the normal force between string and axle, which is what the two pull along
/// their bisector. Returns that largest difference over the mean tension.
inline double coulomb_share(double coefficient, double wrap) {
  return 2.0 * coefficient * std::max(0.0, std::sin(0.5 * wrap));
}

inline constexpr double kTypicalWrap = 2.6;  ///< of play with the hands half a metre apart [rad]

/// The capstan coefficient with the same ratio of tensions at `wrap` [rad].
inline double equivalent_capstan(double coefficient, double wrap = kTypicalWrap) {
  return 2.0 / wrap * std::atanh(0.5 * coulomb_share(coefficient, wrap));
}

/// How a quantity answers to the difference of the two tensions.
struct Answer {
  double value;   ///< without friction
  double change;  ///< per newton of difference
};

/// Solves difference = mean * share * sign(slip) for the difference of the two tensions [N]. The sign is
/// regularised: it grows in proportion to the slip up to `slip_scale` [m/s]. `mean` is in newtons; `slip` in
/// m/s and lessened by the difference.
inline double friction_difference(double share, double slip_scale, const Answer& mean, const Answer& slip) {
  if (!(mean.value > 0.0) || !(share > 0.0) || slip.value == 0.0) return 0.0;
  const double sense = std::copysign(1.0, slip.value);
  const double full = mean.value * share / (1.0 - sense * mean.change * share);
  if (std::abs(slip.value + sense * full * slip.change) >= slip_scale &&
      (slip.value + sense * full * slip.change) * sense > 0.0) {
    return sense * full;
  }
  // The slip stays within the scale, where both sides are linear in each other.
  double low = 0.0;
  double high = full;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    const double sliding = std::min(1.0, sense * (slip.value + sense * middle * slip.change) / slip_scale);
    const bool too_weak = middle < (mean.value + sense * middle * mean.change) * share * sliding;
    (too_weak ? low : high) = middle;
  }
  return sense * low;
}

}  // namespace plant
