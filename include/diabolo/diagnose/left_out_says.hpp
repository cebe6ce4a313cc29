// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "diabolo/math/bootstrap.hpp"

namespace diabolo {

/// What matters to nobody [m], [rad/s], root mean square over half a second: an acceleration that moves a
/// free diabolo by 1 mm leaves 0.04 mm beside the best start.
inline constexpr double kImmaterialPosition = 4e-5, kImmaterialSpin = 0.1;

/// Errors of predictions that matter to nobody [m], [rad/s]. A spin in play is a hundred times that or more.
inline constexpr double kImmaterialAhead = 1e-3, kImmaterialSpinAhead = 0.5;

/// What data that were left out say of something, from the intervals of what it gains, horizon by horizon. An
/// interval in which all is too small to be noticed says nothing.
struct LeftOutSays {
  int horizons = 0;           ///< at which anything is said
  int better = 0, worse = 0;  ///< at so many of them surely
  double leaning = 0.0;       ///< the sum of the gains, each in half widths of its interval

  LeftOutSays(const std::vector<std::optional<Interval>>& gained_ci95, double immaterial) {
    for (const std::optional<Interval>& interval : gained_ci95) {
      if (!interval) continue;
      if (std::max(-interval->low, interval->high) < immaterial) continue;
      ++horizons;
      better += interval->low > 0.0;
      worse += interval->high < 0.0;
      if (const double width = interval->high - interval->low; width > 0.0)
        leaning += (interval->low + interval->high) / width;
    }
  }
  bool against() const { return worse > better; }
  bool leans_against() const { return horizons > 1 && better == 0 && leaning < 0.0; }
};

}  // namespace diabolo
