// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "diabolo/text/shown.hpp"

namespace diabolo {

// Numbers beyond these are none that play comes to.
inline constexpr double kFarthest = 1e3;           ///< from the origin [m]
inline constexpr double kFastest = 100.0;          ///< diabolo and tips [m/s]
inline constexpr double kMostSpin = 1e4;           ///< [rad/s]
inline constexpr double kMostAcceleration = 1e6;   ///< of tips [m/s^2]
inline constexpr double kLatest = 1e9;             ///< time, before and after zero [s]
inline constexpr double kShortestDuration = 1e-6;  ///< between points [s]

/// Throws std::invalid_argument where `value` is no number of at most `most` in size.
inline void check_size(const std::string& what, double value, double most, const char* unit) {
  if (!(std::abs(value) <= most))
    throw std::invalid_argument(what + ": " + shown(value) + ' ' + unit + "; expected " + shown(most) + ' ' +
                                unit + " at most");
}

}  // namespace diabolo
