// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "diabolo/json/fields.hpp"
#include "diabolo/parameters.hpp"

namespace diabolo {

/// Throws RecordingError where the object, `path` of the file with a trailing dot, has a field besides these.
inline void expect_only(const nlohmann::json& object, const std::vector<std::string>& known,
                        const std::string& file, const std::string& path) {
  for (const auto& item : object.items())
    if (std::ranges::find(known, item.key()) == known.end())
      throw RecordingError(file + ": unknown field " + shown(path + item.key()));
}

/// A number within a range; throws RecordingError.
inline double number_within(const JsonFields& fields, const ParameterInfo& info) {
  const std::string name(info.name);
  const double value = fields.number(name);
  if (!(value >= info.minimum && value <= info.maximum))
    fields.fail(name, "a number within [" + shown(info.minimum) + ", " + shown(info.maximum) + "]" +
                          unit_behind(info.unit));
  return value;
}

/// Reads the numeric fields of `target` (Parameters, or an effect) that the object has, each within its
/// range, and returns the names of all. Throws RecordingError.
template <class Target>
std::vector<std::string> read_numbers(const JsonFields& fields, Target& target) {
  std::vector<std::string> names;
  Target::for_each(target, [&](const ParameterInfo& info, double& field) {
    names.emplace_back(info.name);
    if (fields.has(names.back())) field = number_within(fields, info);
  });
  return names;
}

/// The numeric fields of `target` that differ from those of `base`.
template <class Target>
nlohmann::ordered_json changed_numbers(const Target& target, const Target& base) {
  std::vector<double> values;
  Target::for_each(base, [&](const ParameterInfo&, const double& field) { values.push_back(field); });
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  auto value = values.begin();
  Target::for_each(target, [&](const ParameterInfo& info, const double& field) {
    if (field != *value++) json[std::string(info.name)] = field;
  });
  return json;
}

}  // namespace diabolo
