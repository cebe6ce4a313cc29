// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "diabolo/diagnose/fit.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Fewest windows from which anything is concluded.
inline constexpr std::size_t kFewestWindows = 8;

namespace diagnose_detail {

/// Why nothing can be concluded; empty where something can.
inline std::string insufficient(const std::vector<FitTake>& fit_takes) {
  std::size_t windows = 0, taut = 0;
  double seconds = 0.0;
  bool length_known = false;
  std::string odd;
  for (const FitTake& fit_take : fit_takes) {
    windows += fit_take.windows.size();
    const Eigen::VectorXd& times = fit_take.take->times;
    seconds += times[times.size() - 1] - times[0];
    for (const FitWindow& window : fit_take.windows)
      taut += window.start.string_state == StringState::kOnString ? 1 : 0;
    length_known = length_known || usual_path_length(fit_take.take->recording);
    if (!odd.empty()) continue;
    odd = odd_path_length(fit_take.take->recording);
    if (!odd.empty() && fit_takes.size() > 1) odd += " (in " + fit_take.take->recording.name + ")";
  }
  if (windows < kFewestWindows)
    return "only " + std::to_string(windows) + " windows of half a second can be compared, of " +
           shown(std::round(10.0 * seconds) / 10.0) + " s that were recorded; " +
           std::to_string(kFewestWindows) + " are needed, some 5 s of play";
  if (!odd.empty()) return odd;
  if (!length_known || taut * 10 < windows) return "the string is never seen taut for long";
  return {};
}

}  // namespace diagnose_detail

}  // namespace diabolo
