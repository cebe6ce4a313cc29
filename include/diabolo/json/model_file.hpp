// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/json/effects.hpp"
#include "diabolo/json/fields.hpp"
#include "diabolo/json/laws.hpp"
#include "diabolo/json/numbers.hpp"
#include "diabolo/json/residual.hpp"
#include "diabolo/json/rules.hpp"
#include "diabolo/model.hpp"
#include "diabolo/text/file.hpp"

namespace diabolo {

inline constexpr const char* kModelSchema = "diabolo.model/1";

/// Parameters that a recording tells, unless the model has its own.
inline constexpr std::array<std::pair<const char*, bool Model::*>, 3> kRecordedParameters{
    {{"string_length", &Model::own_string_length},
     {"mass", &Model::own_mass},
     {"axle_radius", &Model::own_axle_radius}}};

/// Reads the text of a model file, schema diabolo.model/1:
///   {"schema": "diabolo.model/1", "base": "consistent", "name": "stretchy",
///    "parameters": {"string_length": 1.45}, "rules": {"projection": "closest_point"},
///    "effects": {"string_elasticity": {"stiffness": 600, "damping": 2}},
///    "laws": [...], "residual": {...}, "interpolation": "spline", "from_recording": ["mass", "axle_radius"]}
/// ("laws" as in laws_from_json(), "residual" as in residual_from_json().) Everything but "schema" and "base"
/// (consistent, paper or published) may be left out and is then as in the base; the name is then the file's.
/// "from_recording" lists those of string_length, mass and axle_radius that a recording decides; left out,
/// these are the base's without those that "parameters" gives. Throws RecordingError with file, field, what
/// was found and what was expected.
inline Model read_model(std::string_view text, const std::string& file_name) {
  const nlohmann::json json = parse_json(text, file_name);
  const JsonFields file(json, file_name);
  file.expect_text("schema", kModelSchema);
  file.expect_only({"schema", "base", "name", "parameters", "rules", "effects", "laws", "residual",
                    "interpolation", "from_recording"});
  const bool named = file.has("base") && json.at("base").is_string();
  const std::string base = named ? json.at("base").get<std::string>() : "";
  if (base != "consistent" && base != "paper" && base != "published")
    file.fail("base", "\"consistent\", \"paper\" or \"published\"");
  Model model = model_named(base);
  model.name = std::filesystem::path(file_name).stem().string();
  if (file.has("name")) {
    if (!json.at("name").is_string() || json.at("name") == "") file.fail("name", "a text that is not empty");
    model.name = json.at("name").get<std::string>();
  }
  if (file.has("parameters")) {
    const JsonFields numbers = file.object("parameters");
    expect_only(json.at("parameters"), read_numbers(numbers, model.parameters), file_name, "parameters.");
    for (const auto& [name, own] : kRecordedParameters)
      if (numbers.has(name)) model.*own = true;
  }
  if (file.has("rules")) {
    const JsonFields rules = file.object("rules");
    std::vector<std::string> names;
    Parameters<double>::for_each_rule(model.parameters, [&]<class Rule>(const RuleInfo& info, Rule& rule) {
      const std::string name = info.name;
      names.push_back(name);
      if (rules.has(name)) rule = rule_from_json<Rule>(json.at("rules"), rules, name);
    });
    expect_only(json.at("rules"), names, file_name, "rules.");
  }
  if (file.has("effects")) model.effects = effects_from_json(json.at("effects"), file_name);
  if (file.has("laws")) model.effects.get<FormulaLaws>() = laws_from_json(json.at("laws"), file_name, "laws");
  if (file.has("residual")) model.effects.get<ResidualForce>() = residual_from_json(file.object("residual"));
  if (file.has("interpolation"))
    model.interpolation = rule_from_json<Interpolation>(json, file, "interpolation");
  if (file.has("from_recording")) {
    const nlohmann::json& listed = json.at("from_recording");
    const auto is_known = [](const nlohmann::json& name) {
      return std::ranges::any_of(kRecordedParameters, [&](const auto& entry) { return name == entry.first; });
    };
    if (!listed.is_array() || !std::ranges::all_of(listed, is_known))
      file.fail("from_recording",
                "a list of \"string_length\", \"mass\" and \"axle_radius\", or of some of them");
    for (const auto& [name, own] : kRecordedParameters)
      model.*own = std::ranges::find(listed, nlohmann::json(name)) == listed.end();
  }
  try {
    model.parameters.validate();
  } catch (const std::invalid_argument& error) {
    throw RecordingError(file_name + ": " + error.what());
  }
  return model;
}

/// Reads a model file; see read_model().
inline Model load_model(const std::filesystem::path& path) {
  return read_model(read_file(path), path.string());
}

/// What a model file on this base must say; see read_model().
inline nlohmann::ordered_json changes_from_base(const Model& model, const std::string& base_name) {
  const Model base = model_named(base_name);
  nlohmann::ordered_json json{{"schema", kModelSchema}, {"name", model.name}, {"base", base_name}};
  nlohmann::ordered_json numbers = changed_numbers(model.parameters, base.parameters);
  for (const auto& [name, own] : kRecordedParameters)
    if (model.*own && !(base.*own) && !numbers.contains(name))
      Parameters<double>::for_each(model.parameters,
                                   [&, &key = name](const ParameterInfo& info, double field) {
                                     if (info.name == key) numbers[key] = field;
                                   });
  bool told_by_numbers = true;
  nlohmann::ordered_json from_recording = nlohmann::ordered_json::array();
  for (const auto& [name, own] : kRecordedParameters) {
    told_by_numbers = told_by_numbers && model.*own == (base.*own || numbers.contains(name));
    if (!(model.*own)) from_recording.push_back(name);
  }
  nlohmann::ordered_json rules = nlohmann::ordered_json::object(), base_rules = rules;
  Parameters<double>::for_each_rule(model.parameters, [&](const RuleInfo& info, const auto& rule) {
    rules[info.name] = rule_to_json(rule);
  });
  Parameters<double>::for_each_rule(base.parameters, [&](const RuleInfo& info, const auto& rule) {
    if (rules[info.name] == rule_to_json(rule)) rules.erase(info.name);
  });
  if (!numbers.empty()) json["parameters"] = numbers;
  if (!rules.empty()) json["rules"] = rules;
  if (nlohmann::ordered_json effects = to_json(model.effects); !effects.empty()) json["effects"] = effects;
  if (nlohmann::ordered_json laws = to_json(model.effects.get<FormulaLaws>()); !laws.empty())
    json["laws"] = laws;
  if (const auto& law = model.effects.get<ResidualForce>().law) json["residual"] = to_json(*law);
  if (model.interpolation != base.interpolation) json["interpolation"] = rule_to_json(model.interpolation);
  if (!told_by_numbers) json["from_recording"] = from_recording;
  return json;
}

/// The text of a model file that reads back as the same model, bit for bit, on the base that leaves least to
/// say. Throws std::invalid_argument where the model is out of range or has no name.
inline std::string write_model(const Model& model) {
  model.parameters.validate();
  model.effects.validate();
  if (model.name.empty()) throw std::invalid_argument("name: empty; a model in a file needs one");
  std::optional<nlohmann::ordered_json> shortest;
  for (const char* base : {"consistent", "paper", "published"}) {
    nlohmann::ordered_json json = changes_from_base(model, base);
    if (!shortest || json.flatten().size() < shortest->flatten().size()) shortest = std::move(json);
  }
  return json_text(*shortest, "model");
}

/// Writes a model file, whole or not at all; see write_model().
inline void save_model(const Model& model, const std::filesystem::path& path) {
  FilesToWrite files;
  files.add(path, write_model(model));
  files.commit();
}

}  // namespace diabolo
