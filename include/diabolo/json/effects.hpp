// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "diabolo/effects/all.hpp"
#include "diabolo/json/fields.hpp"
#include "diabolo/json/numbers.hpp"

namespace diabolo {

/// In files an elastic string has a stiffness; "compliance" [m/N] may stand for it.
inline constexpr ParameterInfo kStiffness{"stiffness", "N/m", 1.0, 1e9, "tension per extension of the path"};

/// The stiffness whose inverse is exactly this compliance; a few doubles have none.
inline std::optional<double> stiffness_of(double compliance) {
  const double inverse = 1.0 / compliance;
  for (const double stiffness : {inverse, std::nextafter(inverse, 0.0), std::nextafter(inverse, 1e300)})
    if (stiffness >= kStiffness.minimum && stiffness <= kStiffness.maximum && 1.0 / stiffness == compliance)
      return stiffness;
  return std::nullopt;
}

/// Reads {"string_elasticity": {"stiffness": 600, "damping": 2}} and the like: effects by name, each with its
/// parameters by theirs; what is left out is neutral. `object` is field "effects" of the file. Throws
/// RecordingError.
inline AllEffects<double> effects_from_json(const nlohmann::json& object, const std::string& file) {
  const JsonFields fields(object, file, "effects.");
  AllEffects<double> effects;
  std::vector<std::string> known;
  const auto read = [&]<class Effect>(Effect& effect) {
    if constexpr (Effect::kHasText) return;  // see laws_from_json()
    const std::string name(Effect::kName);
    known.push_back(name);
    if (!fields.has(name)) return;
    const JsonFields own = fields.object(name);
    std::vector<std::string> names = read_numbers(own, effect);
    if constexpr (std::is_same_v<Effect, StringElasticity<double>>) {
      names.emplace_back(kStiffness.name);
      if (own.has("stiffness") && own.has("compliance"))
        own.fail("compliance", "no such field beside \"stiffness\"");
      if (own.has("stiffness")) effect.compliance_per_newton = 1.0 / number_within(own, kStiffness);
    }
    expect_only(object.at(name), names, file, "effects." + name + ".");
  };
  std::apply([&](auto&... effect) { (read(effect), ...); }, effects.members);
  expect_only(object, known, file, "effects.");
  return effects;
}

/// The effects that are not neutral; reads back as the same doubles.
inline nlohmann::ordered_json to_json(const AllEffects<double>& effects) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  const auto write = [&]<class Effect>(const Effect& effect) {
    if constexpr (Effect::kHasText) return;
    nlohmann::ordered_json own = changed_numbers(effect, Effect{});
    if constexpr (std::is_same_v<Effect, StringElasticity<double>>) {
      if (own.contains("compliance"))
        if (const std::optional<double> stiffness = stiffness_of(effect.compliance_per_newton)) {
          own.erase("compliance");
          own["stiffness"] = *stiffness;
        }
    }
    if (!own.empty()) json[std::string(Effect::kName)] = own;
  };
  std::apply([&](const auto&... effect) { (write(effect), ...); }, effects.members);
  return json;
}

}  // namespace diabolo
