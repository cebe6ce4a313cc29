// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/effects/formula_laws.hpp"
#include "diabolo/json/fields.hpp"
#include "diabolo/json/rules.hpp"
#include "diabolo/text/file.hpp"

namespace diabolo {

inline constexpr const char* kLawsSchema = "diabolo.laws/1";

namespace json_detail {

/// A number of a law and, where it is told, its value.
inline std::pair<LawNumber, double> law_number_from_json(const JsonFields& fields,
                                                         const nlohmann::json& json) {
  fields.expect_only({"name", "unit", "usual", "expected", "minimum", "maximum", "value"});
  LawNumber number;
  number.name = fields.text("name");
  number.unit = fields.has("unit") ? fields.text("unit") : "1";
  for (const auto& [field, into] : {std::pair("usual", &number.usual),
                                    {"expected", &number.expected},
                                    {"minimum", &number.minimum},
                                    {"maximum", &number.maximum}})
    if (fields.has(field)) *into = fields.number(field);
  return {number, json.contains("value") ? fields.number("value") : number.expected};
}

}  // namespace json_detail

/// Reads a list of laws, such as
///   [{"name": "creep", "plain": "a string that creeps", "acts": "string", "formula": "rate * t",
///     "numbers": [{"name": "rate", "unit": "m/s", "usual": 0.001, "minimum": 0, "maximum": 0.1}]}]
/// with the values of the numbers where a "value" is told; else an amplitude is zero, and the others are as
/// expected. `list` is field `field` of the file. Throws RecordingError.
inline FormulaLaws<double> laws_from_json(const nlohmann::json& list, const std::string& file,
                                          const std::string& field) {
  if (!list.is_array())
    throw RecordingError(file + ": field " + shown(field) + " is of type " + list.type_name() +
                         "; expected a list of laws");
  std::vector<Law> laws;
  std::vector<double> values;
  try {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string path = field + "[" + std::to_string(i) + "].";
      const JsonFields fields(list[i], file, path);
      fields.expect_only({"name", "plain", "acts", "formula", "numbers"});
      const nlohmann::json& own = fields.list("numbers");
      std::vector<LawNumber> numbers;
      for (std::size_t k = 0; k < own.size(); ++k) {
        const JsonFields number(own[k], file, path + "numbers[" + std::to_string(k) + "].");
        auto [told, value] = json_detail::law_number_from_json(number, own[k]);
        numbers.push_back(std::move(told));
        values.push_back(value);
      }
      fields.text("acts");  // or it is told that it lacks
      laws.emplace_back(fields.text("name"), fields.has("plain") ? fields.text("plain") : "",
                        rule_from_json<Acts>(list[i], fields, "acts"), fields.text("formula"),
                        std::move(numbers));
    }
    FormulaLaws<double> result(std::move(laws));
    for (std::size_t i = 0; i < values.size(); ++i) result.numbers[i] = values[i];
    validate_fields<double>(result, "laws ");
    return result;
  } catch (const RecordingError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw RecordingError(file + ": " + error.what());
  }
}

/// The laws with their numbers' values; reads back as the same.
inline nlohmann::ordered_json to_json(const FormulaLaws<double>& laws) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  laws.each([&](const Law& law, std::size_t first) {
    nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < law.numbers.size(); ++i) {
      const LawNumber& number = law.numbers[i];
      nlohmann::ordered_json one{{"name", number.name}, {"unit", number.unit}, {"usual", number.usual}};
      if (i > 0) one["expected"] = number.expected;
      one["minimum"] = number.minimum;
      one["maximum"] = number.maximum;
      one["value"] = laws.numbers[first + i];
      numbers.push_back(std::move(one));
    }
    list.push_back({{"name", law.name},
                    {"plain", law.plain},
                    {"acts", names_of(Acts{})[static_cast<std::size_t>(law.acts)]},
                    {"formula", law.formula.text()},
                    {"numbers", std::move(numbers)}});
  });
  return list;
}

/// Reads the text of a file of laws: {"schema": "diabolo.laws/1", "laws": [...]}, or the list alone. Throws
/// RecordingError with file, field, what was found and what was expected.
inline FormulaLaws<double> read_laws(std::string_view text, const std::string& file_name) {
  const nlohmann::json json = parse_json(text, file_name);
  if (json.is_array()) return laws_from_json(json, file_name, "laws");
  const JsonFields file(json, file_name);
  file.expect_text("schema", kLawsSchema);
  file.expect_only({"schema", "laws"});
  return laws_from_json(file.list("laws"), file_name, "laws");
}

/// Reads a file of laws; see read_laws().
inline FormulaLaws<double> load_laws(const std::filesystem::path& path) {
  return read_laws(read_file(path), path.string());
}

/// The text of such a file.
inline std::string write_laws(const FormulaLaws<double>& laws) {
  return json_text({{"schema", kLawsSchema}, {"laws", to_json(laws)}}, "laws");
}

}  // namespace diabolo
