// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "arrays.hpp"
#include "diabolo/sticks.hpp"

namespace diabolo::python {

/// The tips at the beginning and at the end of a step, as Predictor.step takes them.
struct StepTips {
  Tips<double> begin, end;

  /// Throws std::invalid_argument where a shape, the step's length or a direction is not as it has to be.
  StepTips(const Array& left0, const Array& right0, const Array& left1, const Array& right1, double dt,
           const std::optional<std::array<Array, 4>>& velocities,
           const std::optional<std::array<Array, 4>>& directions, double time);
};

}  // namespace diabolo::python
