// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "diabolo/diagnose/fit.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"

namespace diabolo {

/// Fewest windows from which anything is concluded.
inline constexpr std::size_t kFewestWindows = 8;

namespace detail {

/// Why nothing can be concluded; empty where something can.
inline std::string insufficient(const std::vector<Stage>& stages) {
  std::size_t windows = 0, taut = 0;
  bool length_known = false;
  std::string odd;
  for (const Stage& stage : stages) {
    windows += stage.windows.size();
    for (const FitWindow& window : stage.windows)
      taut += window.start.string_state == StringState::kOnString ? 1 : 0;
    length_known = length_known || usual_path_length(stage.take->recording);
    if (!odd.empty()) continue;
    odd = odd_path_length(stage.take->recording);
    if (!odd.empty() && stages.size() > 1) odd += " (in " + stage.take->recording.name + ")";
  }
  if (windows < kFewestWindows)
    return "only " + std::to_string(windows) + " windows of half a second can be compared; " +
           std::to_string(kFewestWindows) + " are needed";
  if (!odd.empty()) return odd;
  if (!length_known || taut * 10 < windows) return "the string is never seen taut for long";
  return {};
}

}  // namespace detail

}  // namespace diabolo
