// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/diagnose/ladder.hpp"
#include "diabolo/model.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// What best_guess() takes from a ladder.
inline constexpr std::array<std::string_view, 3> kGuessed{"string_length", "air_drag_quadratic",
                                                          "magnus_lift"};

/// Throws std::invalid_argument where a row that best_guess() takes has no sensible numbers.
inline void check_guessed(const std::vector<LadderRow>& ladder) {
  constexpr double kLargest = 1e6;
  for (std::size_t i = 0; i < ladder.size(); ++i) {
    const std::string place = "ladder[" + std::to_string(i) + "]";
    if (ladder[i].name.empty())
      throw std::invalid_argument(place + ": no name; expected a candidate with one");
    if (std::ranges::find(kGuessed, ladder[i].name) == kGuessed.end()) continue;
    for (const auto& [field, value] : {std::pair{"z", ladder[i].z}, {"estimate", ladder[i].estimate}})
      if (!(std::abs(value) <= kLargest))
        throw std::invalid_argument(place + ", " + field + ": " + shown(value) +
                                    "; expected a number of at most " + shown(kLargest));
  }
}

/// The model that a diagnosis made, as a plan is best made on: with the string's length put right, where it
/// was measured wrongly, and with the likeliest air drag and Magnus lift where they were too unsure to be
/// claimed. Of an estimate that is z standard deviations away from zero the share 1 - 1 / z^2 counts; where z
/// is below one, nothing. `model`: that of the diagnosis with what it leaves to the recording, see
/// model_for().
inline Model best_guess(Model model, const std::vector<LadderRow>& ladder) {
  check_guessed(ladder);
  const auto row = [&](std::string_view name) {
    const auto found = std::ranges::find(ladder, name, &LadderRow::name);
    return found == ladder.end() ? nullptr : &*found;
  };
  const auto claimed = [&](std::string_view name) { return row(name) != nullptr && row(name)->claimed; };
  const auto likeliest = [&](std::string_view name) {
    const LadderRow* const found = row(name);
    if (found == nullptr || found->claimed || !(std::abs(found->z) > 1.0)) return 0.0;
    return found->estimate * (1.0 - 1.0 / (found->z * found->z));
  };
  if (claimed("string_length") && !model.own_string_length) {
    model.parameters.string_length += row("string_length")->estimate;
    model.parameters.validate();
  }
  if (!claimed("air_drag_linear"))
    model.effects.get<Air>().quadratic_drag += std::max(0.0, likeliest("air_drag_quadratic"));
  model.effects.get<MagnusLift>().coefficient += likeliest("magnus_lift");
  model.effects.validate();
  return model;
}

}  // namespace diabolo
