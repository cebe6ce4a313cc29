// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "scenario.hpp"

namespace plant {

/// One play, looked at by the cameras and, more often, by nobody.
struct Take {
  std::vector<Moment> filmed;  ///< at `diabolo_times`
  std::vector<Moment> truth;   ///< at the scenario's `truth_rate`; empty unless asked for
  bool missed = false;         ///< whether the diabolo fell past the string before the scenario's end
};

/// Plays a scenario. Throws std::invalid_argument when there is no start or nothing to film,
/// std::domain_error when play comes to a state that the plant has no law for.
Take take(const Scenario& scenario, bool with_truth);

}  // namespace plant
