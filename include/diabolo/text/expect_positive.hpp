// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Throws std::invalid_argument that names `what` where a value in that unit is not above zero, at most
/// `most`.
inline void expect_positive(std::string_view what, double value, double most = 1e6,
                            std::string_view unit = {}) {
  if (value > 0.0 && value <= most) return;
  throw std::invalid_argument(std::string(what) + ": " + shown(value) + (unit.empty() ? "" : " ") +
                              std::string(unit) + "; expected a positive number up to " + shown(most));
}

}  // namespace diabolo
