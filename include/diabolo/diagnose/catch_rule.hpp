// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// A catch with a string that hangs slack, where the simulator's rule wants it taut.
struct CatchRule {
  static constexpr const char* kName = "CatchRule";
  static constexpr const char* kDoc =
      "The simulator catches with a taut string only, and these recordings show catches with a slack one.";

  double catch_slack_m = kNaN, error_before_m = kNaN, error_after_m = kNaN;
  std::size_t starts_for = 0, starts_against = 0;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("catch_slack_m", &CatchRule::catch_slack_m,
          "How much closer than the string is long the tips may be; it is in the model.");
    visit("error_before_m", &CatchRule::error_before_m,
          "Mean position error up to 1 s ahead by the simulator's rule, of recordings that were fitted, "
          "with what was found until then.");
    visit("error_after_m", &CatchRule::error_after_m,
          "Mean position error of the same starts by the wider rule.");
    visit("starts_for", &CatchRule::starts_for,
          "Starts that are predicted better by the wider rule, by ten times what their noise makes.");
    visit("starts_against", &CatchRule::starts_against,
          "Starts that are predicted worse by the wider rule, by ten times what their noise makes.");
  }
};

/// A sentence after the answer's, or none.
inline std::string catch_in_words(const std::optional<CatchRule>& rule) {
  if (!rule) return "";
  const auto millimetres = [](double metres) { return std::to_string(std::lround(1e3 * metres)) + " mm"; };
  return " The simulator's rule for a catch is too strict: where slack strings catch too, the mean error up "
         "to 1 s ahead is " +
         millimetres(rule->error_after_m) + " instead of " + millimetres(rule->error_before_m) + ".";
}

}  // namespace diabolo
