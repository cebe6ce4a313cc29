// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "diabolo/math/fields.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Where the terms of direction `k` of a residual law begin: right, forward, up; and, for 3, where the last
/// end. A function, since the kernels of several instruction sets must not share a symbol.
constexpr std::size_t residual_begin(std::size_t k) { return k == 0 ? 0 : k == 1 ? 10 : k == 2 ? 18 : 25; }
inline constexpr std::size_t kResidualTerms = residual_begin(3);
inline constexpr std::size_t kResidualInputs = 8;

/// A residual law where the diabolo is on the string, or off it: the weights of ResidualScene::terms [m/s^2]
/// and the range of ResidualScene::inputs in which they were learnt.
struct ResidualPart {
  std::array<double, kResidualTerms> weights{};
  std::array<double, kResidualInputs> low{}, high{};

  bool operator==(const ResidualPart&) const = default;
};

/// An acceleration that was learnt from what named physics leaves.
struct ResidualLaw {
  static constexpr ParameterInfo kLargest{"largest", "m/s^2", 1e-6, 20.0, "it is never larger"},
      kPower{"power", "W/kg", 0.0, 100.0, "it never does more work"};
  static constexpr double kMost = 1e3;  ///< of a weight or the end of a range

  double largest = kLargest.maximum, power = kPower.maximum;
  ResidualPart on_string, off_string;

  bool operator==(const ResidualLaw&) const = default;

  /// Throws std::invalid_argument naming the field, its value and what was expected.
  void validate() const {
    const auto check = [](const std::string& name, double value, double least, double most) {
      if (!(value >= least && value <= most))
        throw std::invalid_argument("residual " + name + ": " + shown(value) + "; must be within [" +
                                    shown(least) + ", " + shown(most) + "]");
    };
    check("largest", largest, kLargest.minimum, kLargest.maximum);
    check("power", power, kPower.minimum, kPower.maximum);
    for (const auto& [name, part] : {std::pair("on_string ", &on_string), {"off_string ", &off_string}}) {
      for (const double weight : part->weights) check(name + std::string("weight"), weight, -kMost, kMost);
      for (std::size_t i = 0; i < kResidualInputs; ++i) {
        check(name + std::string("low"), part->low[i], -kMost, kMost);
        check(name + std::string("high"), part->high[i], part->low[i], kMost);
      }
    }
  }
};

}  // namespace diabolo
