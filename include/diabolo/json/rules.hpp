// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>

#include "diabolo/json/fields.hpp"
#include "diabolo/parameters.hpp"

namespace diabolo {

/// A choice by name, a bool, or a direction [x, y, z] of norm 1.
template <class Rule>
nlohmann::ordered_json rule_to_json(const Rule& rule) {
  if constexpr (std::is_enum_v<Rule>)
    return names_of(rule)[static_cast<std::size_t>(rule)];
  else if constexpr (std::is_same_v<Rule, bool>)
    return rule;
  else
    return {rule.x(), rule.y(), rule.z()};
}

/// The rule in field `name` of `json`, an object that has it and that `fields` reads. Throws RecordingError.
template <class Rule>
Rule rule_from_json(const nlohmann::json& json, const JsonFields& fields, const std::string& name) {
  const nlohmann::json& value = json.at(name);
  if constexpr (std::is_enum_v<Rule>) {
    const auto names = names_of(Rule{});
    for (std::size_t i = 0; i < names.size(); ++i)
      if (value == names[i]) return static_cast<Rule>(i);
    std::string expected;
    for (std::size_t i = 0; i < names.size(); ++i)
      expected += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + shown(names[i]);
    fields.fail(name, expected);
  } else if constexpr (std::is_same_v<Rule, bool>) {
    if (!value.is_boolean()) fields.fail(name, "true or false");
    return value.get<bool>();
  } else {
    Rule direction = fields.vector3(name);
    if (!(std::abs(direction.norm() - 1.0) < 1e-9)) fields.fail(name, "a direction [x, y, z] of norm 1");
    return direction;
  }
}

}  // namespace diabolo
