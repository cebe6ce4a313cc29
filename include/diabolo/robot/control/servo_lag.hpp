// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/robot/arm/joint_limits.hpp"

namespace diabolo {

/// How late arms follow what they are sent.
struct ServoLag {
  double lag = 0;       ///< [s]
  double residual = 0;  ///< [rad] that is left, root mean square over ticks and joints, at that lag
  bool certain = true;  ///< false where the arms hardly move, or the lag may be larger than was looked for
};

/// The lag at which `actual` [rad] lies closest to `commanded`, both one tick apart: the least mean square
/// over whole ticks, then the vertex of the parabola through its neighbours. A servo's lag varies with what
/// it follows; this is its mean over the motion. Throws std::invalid_argument where the sizes differ or there
/// are fewer ticks than twice the largest lag.
inline ServoLag estimate_lag(const std::vector<PairJoints>& commanded, const std::vector<PairJoints>& actual,
                             double largest = 0.25) {
  const auto most = static_cast<std::size_t>(std::ceil(largest / kTick));
  if (commanded.size() != actual.size() || actual.size() < 2 * most + 2)
    throw std::invalid_argument("lag: " + std::to_string(commanded.size()) + " commanded and " +
                                std::to_string(actual.size()) + " actual ticks; must be as many, and " +
                                std::to_string(2 * most + 2) + " or more");
  const double count = static_cast<double>(2 * kJointCount) * static_cast<double>(actual.size() - most);
  std::vector<double> error(most + 1);
  for (std::size_t lag = 0; lag <= most; ++lag)
    for (std::size_t i = most; i < actual.size(); ++i)
      error[lag] += (actual[i] - commanded[i - lag]).squaredNorm() / count;
  const auto best = static_cast<std::size_t>(std::ranges::min_element(error) - error.begin());
  ServoLag result{static_cast<double>(best) * kTick, std::sqrt(error[best])};
  result.certain = best > 0 && best < most && std::ranges::max(error) > 1e-8;
  if (!result.certain) return result;
  const double before = error[best - 1], after = error[best + 1], bend = before - 2 * error[best] + after;
  if (bend > 0) result.lag += 0.5 * kTick * (before - after) / bend;
  return result;
}

}  // namespace diabolo
