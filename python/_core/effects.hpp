// SPDX-License-Identifier: MIT
#pragma once

#include <cctype>
#include <string>
#include <string_view>

#include "diabolo/effects/all.hpp"

#include "fields.hpp"

namespace diabolo::python {

/// "string_elasticity" as "StringElasticity".
inline std::string class_name(std::string_view name) {
  std::string result;
  bool capital = true;
  for (const char c : name) {
    if (c != '_') result += capital ? static_cast<char>(std::toupper(c)) : c;
    capital = c == '_';
  }
  return result;
}

template <class Effect>
void validate_effect(const Effect& effect) {
  validate_fields<double>(effect, std::string(Effect::kName).append(" "));
}

template <class Effect>
py::dict effect_to_dict(const Effect& effect) {
  py::dict fields;
  add_numbers(effect, fields);
  return fields;
}

template <class Effect>
Effect effect_from_dict(const py::dict& fields) {
  Effect effect;
  for (const auto& [key, value] : fields) {
    const std::string name = py::str(key);
    double* const number = find_number(effect, name);
    if (!number) throw py::type_error(class_name(Effect::kName) + " has no field '" + name + "'");
    *number = cast_to<double>(value, name, "a number");
  }
  validate_effect(effect);
  return effect;
}

/// Calls `visit(effect)` for each effect of a set that is numbers alone.
template <class Set, class Visitor>
void for_each_effect(Set& set, Visitor&& visit) {
  const auto one = [&]<class Effect>(Effect& effect) {
    if constexpr (!Effect::kHasText) visit(effect);
  };
  std::apply([&](auto&... effect) { (one(effect), ...); }, set.members);
}

/// Takes over an effect by its name; None has the amplitude zero, and a list makes FormulaLaws. Throws
/// py::type_error about anything else.
void assign_effect(AllEffects<double>& effects, const std::string& name, const py::object& given);

/// The same of all that are given by keyword.
void assign_effects(AllEffects<double>& effects, const py::kwargs& given);

}  // namespace diabolo::python
