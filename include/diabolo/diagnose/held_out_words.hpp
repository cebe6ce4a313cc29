// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diabolo/diagnose/adequacy_words.hpp"
#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/left_out_says.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// The first horizon at which what was found is farther off than the base in the mean, by more than matters
/// to anybody and farther than the base's error and the noise of the starts are together, in squares.
inline std::optional<std::size_t> first_worse(const ErrorsByHorizon& errors, double immaterial) {
  for (std::size_t h = 0; h < errors.start_error.size(); ++h) {
    const std::optional<double>&base = errors.base_error[h], &found = errors.augmented_error[h];
    const double noise = errors.start_error[h].value_or(0.0);
    const bool nearer = errors.improvement_ci95[h] && errors.improvement_ci95[h]->low > 0.0;
    if (base && found && !nearer && *found > *base + immaterial && *found > std::hypot(*base, noise))
      return h;
  }
  return std::nullopt;
}

/// That what was found predicts worse than the base somewhere: sentences, empty where it does not.
inline std::string worse_ahead_in_words(const HeldOut& heldout) {
  std::string text;
  const auto add = [&](const ErrorsByHorizon& errors, const char* what, const char* unit, double immaterial) {
    const std::optional<std::size_t> h = first_worse(errors, immaterial);
    if (!h) return;
    text += " But " + shown(heldout.horizons[*h]) + " s ahead on held-out data its " + what + " is off by " +
            size_in_words(*errors.augmented_error[*h], unit) + ", the base's by " +
            size_in_words(*errors.base_error[*h], unit) + ".";
  };
  add(heldout.position, "place", "m", kImmaterialAhead);
  add(heldout.spin, "spin", "rad/s", kImmaterialSpinAhead);
  return text;
}

}  // namespace diabolo
