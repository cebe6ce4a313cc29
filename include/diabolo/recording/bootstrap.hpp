// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <random>
#include <vector>

namespace diabolo {

struct Interval {
  double low, high;
};

/// What a set of errors looks like.
struct ErrorSummary {
  std::size_t windows;                 ///< how many errors, at least one
  double mean, median, percentile_90;  ///< [m]
  std::optional<Interval> mean_ci95;   ///< [m]; none where the errors are too few to tell
};

}  // namespace diabolo
