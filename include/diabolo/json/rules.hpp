// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>

#include "diabolo/json/fields.hpp"
#include "diabolo/parameters.hpp"
#include "diabolo/sticks.hpp"

namespace diabolo {

// Names of the values of each choice, in the order of their numbers from 0.
inline constexpr std::array<std::string_view, 2> names_of(StringLaw) {
  return {"pull_velocity", "inextensible"};
}
inline constexpr std::array<std::string_view, 2> names_of(Projection) { return {"radial", "closest_point"}; }
inline constexpr std::array<std::string_view, 2> names_of(NormalRule) { return {"published", "true"}; }
inline constexpr std::array<std::string_view, 3> names_of(FlightRule) {
  return {"published", "paper", "slack"};
}
inline constexpr std::array<std::string_view, 2> names_of(ThinRule) { return {"published", "paper"}; }
inline constexpr std::array<std::string_view, 2> names_of(SpinRule) { return {"slip", "length_change"}; }
inline constexpr std::array<std::string_view, 2> names_of(Integrator) { return {"euler", "parabolic"}; }
inline constexpr std::array<std::string_view, 3> names_of(Interpolation) {
  return {"held", "linear", "spline"};
}

/// Calls `visit(name, field)` for every field of Parameters that is not numeric: choices, bools, and the
/// plane's normal.
template <class Self, class Visitor>
void for_each_rule(Self& parameters, Visitor&& visit) {
  visit("string_law", parameters.string_law);
  visit("projection", parameters.projection);
  visit("normal_rule", parameters.normal_rule);
  visit("flight_rule", parameters.flight_rule);
  visit("thin_rule", parameters.thin_rule);
  visit("spin_rule", parameters.spin_rule);
  visit("integrator", parameters.integrator);
  visit("per_step", parameters.per_step);
  visit("release_when_overstretched", parameters.release_when_overstretched);
  visit("planar", parameters.planar);
  visit("plane_normal", parameters.plane_normal);
}

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
