// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "diabolo/effects/residual_force.hpp"
#include "diabolo/json/fields.hpp"
#include "diabolo/json/numbers.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

namespace json_detail {

template <std::size_t N>
void read_list(const JsonFields& fields, const std::string& name, std::array<double, N>& numbers) {
  const nlohmann::json& list = fields.list(name);
  const std::string expected =
      "a list of " + std::to_string(N) + " numbers of at most " + shown(ResidualLaw::kMost);
  if (list.size() != N) fields.fail(name, expected);
  for (std::size_t i = 0; i < N; ++i) {
    if (list[i].is_number()) numbers[i] = list[i].get<double>();
    if (!list[i].is_number() || !(std::abs(numbers[i]) <= ResidualLaw::kMost)) fields.fail(name, expected);
  }
}

inline ResidualPart residual_part(const JsonFields& fields) {
  fields.expect_only({"weights", "low", "high"});
  ResidualPart part;
  read_list(fields, "weights", part.weights);
  read_list(fields, "low", part.low);
  read_list(fields, "high", part.high);
  for (std::size_t i = 0; i < kResidualInputs; ++i)
    if (part.high[i] < part.low[i]) fields.fail("high", "no number below that of \"low\"");
  return part;
}

inline nlohmann::ordered_json to_json(const ResidualPart& part) {
  return {{"weights", part.weights}, {"low", part.low}, {"high", part.high}};
}

}  // namespace json_detail

/// Reads {"largest": 1.2, "power": 2.5, "on_string": {"weights": [25 numbers], "low": [8], "high": [8]},
/// "off_string": {...}}, as in ResidualLaw. Throws RecordingError.
inline ResidualForce<double> residual_from_json(const JsonFields& fields) {
  fields.expect_only({"largest", "power", "on_string", "off_string"});
  ResidualLaw law;
  law.largest = number_within(fields, ResidualLaw::kLargest);
  law.power = number_within(fields, ResidualLaw::kPower);
  law.on_string = json_detail::residual_part(fields.object("on_string"));
  law.off_string = json_detail::residual_part(fields.object("off_string"));
  return ResidualForce<double>(law);
}

/// The same as a file has it.
inline nlohmann::ordered_json to_json(const ResidualLaw& law) {
  return {{"largest", law.largest},
          {"power", law.power},
          {"on_string", json_detail::to_json(law.on_string)},
          {"off_string", json_detail::to_json(law.off_string)}};
}

}  // namespace diabolo
