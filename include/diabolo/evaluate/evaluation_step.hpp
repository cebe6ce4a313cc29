// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "diabolo/math/vector3.hpp"
#include "diabolo/recording/check.hpp"
#include "diabolo/recording/tip_motion.hpp"

namespace diabolo {

/// Steps from a start until the first one at or after `seconds` later; a step within a microsecond of it
/// counts as at it.
inline std::size_t steps_until(double seconds) {
  return static_cast<std::size_t>(std::max(0.0, std::ceil(seconds / kEvaluationStep - 1e-3)));
}

/// Whether a predicted position can be compared at all: finite, and within what is believed of a recording.
inline bool is_in_world(const Vector3<double>& position) {
  return (position.cwiseAbs().array() <= kLargestCoordinate).all();
}

}  // namespace diabolo
