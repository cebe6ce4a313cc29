// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "diabolo/math/bootstrap.hpp"

namespace diabolo {

/// What data that were left out say of something, from the intervals of what it gains, horizon by horizon.
struct LeftOutSays {
  int horizons = 0;           ///< at which anything is said
  int better = 0, worse = 0;  ///< at so many of them surely
  double leaning = 0.0;       ///< the sum of the gains, each in half widths of its interval

  explicit LeftOutSays(const std::vector<std::optional<Interval>>& gained_ci95) {
    for (const std::optional<Interval>& interval : gained_ci95) {
      if (!interval) continue;
      ++horizons;
      better += interval->low > 0.0;
      worse += interval->high < 0.0;
      if (const double width = interval->high - interval->low; width > 0.0)
        leaning += (interval->low + interval->high) / width;
    }
  }
  bool against() const { return worse > 0 && better == 0; }
  bool leans_against() const { return horizons > 1 && better == 0 && leaning < 0.0; }
};

}  // namespace diabolo
