// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diabolo/math/bootstrap.hpp"
#include "diabolo/recording/recording.hpp"

// Parts of a DiagnosisResult, see diagnosis_result.hpp: numbers and their intervals.
namespace diabolo {

/// Interval of each horizon; nothing where it cannot be told.
using IntervalByHorizon = std::vector<std::optional<Interval>>;
using NumberByHorizon = std::vector<std::optional<double>>;

struct Estimate {
  static constexpr const char* kName = "Estimate";
  static constexpr const char* kDoc = "A number that was estimated.";

  std::string name;
  double value = kNaN;
  std::string unit;
  std::optional<Interval> ci90;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("name", &Estimate::name, "By its fixed name.");
    visit("value", &Estimate::value, "In its unit.");
    visit("unit", &Estimate::unit, "1 for a plain number.");
    visit("ci90", &Estimate::ci90, "90 % interval.");
  }
};

}  // namespace diabolo
