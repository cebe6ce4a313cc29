// SPDX-License-Identifier: MIT
#include "diabolo/json/model_file.hpp"

#include "catch.hpp"
#include "random.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

namespace {

std::string file_with(const std::string& fields) {
  return R"({"schema": "diabolo.model/1", "base": "consistent")" + fields + "}";
}

std::string model_complaint(const std::string& text) {
  return complaint([&] { read_model(text, "m.json"); });
}

bool same(const Model& a, const Model& b) {
  bool equal = a.name == b.name && a.interpolation == b.interpolation &&
               a.own_string_length == b.own_string_length && a.own_mass == b.own_mass &&
               a.own_axle_radius == b.own_axle_radius && a.parameters.same_rules(b.parameters);
  const auto& elastic_a = a.effects.get<StringElasticity>();
  const auto& elastic_b = b.effects.get<StringElasticity>();
  equal = equal && elastic_a.compliance_per_newton == elastic_b.compliance_per_newton &&
          elastic_a.damping == elastic_b.damping;
  return equal && changed_numbers(a.parameters, b.parameters).empty();
}

Model random_model(Random& random) {
  Model model =
      model_named(std::array{"published", "paper", "consistent"}[static_cast<std::size_t>(random.index(3))]);
  model.name = random.chance(0.5) ? "a \"model\" of \xce\xbc" : model.name;
  Parameters<double>::for_each(model.parameters, [&](const ParameterInfo& info, double& field) {
    if (random.chance(0.3)) field = random.uniform(info.minimum, info.maximum);
  });
  model.parameters.spin_coupling = random.uniform(0.0, 1.0) / model.parameters.pull.reference_step;
  model.parameters.spin_coupling = std::min(model.parameters.spin_coupling, 1000.0);
  Parameters<double>::for_each_rule(model.parameters, [&]<class Rule>(const RuleInfo&, Rule& rule) {
    if (random.chance(0.6)) return;
    if constexpr (std::is_enum_v<Rule>)
      rule = static_cast<Rule>(random.index(static_cast<int>(names_of(Rule{}).size())));
    else if constexpr (std::is_same_v<Rule, bool>)
      rule = random.chance(0.5);
    else
      rule = random.direction().normalized();
  });
  if (model.parameters.string_law != StringLaw::kInextensible) model.parameters.follow_turns = false;
  StringElasticity<double>& elasticity = model.effects.get<StringElasticity>();
  if (random.chance(0.5)) elasticity.compliance_per_newton = random.log_uniform(1e-6, 1.0);
  if (random.chance(0.5)) elasticity.damping = random.uniform(0.0, 1e4);
  model.interpolation = static_cast<Interpolation>(random.index(3));
  for (const auto& [name, own] : kRecordedParameters)
    if (random.chance(0.5)) model.*own = random.chance(0.5);
  return model;
}

}  // namespace

TEST_CASE("A model survives its file bit for bit") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  Random random(seed);
  for (int k = 0; k < 2000; ++k) {
    const Model model = random_model(random);
    const std::string text = write_model(model);
    CAPTURE(text);
    REQUIRE(same(read_model(text, "m.json"), model));
    REQUIRE(write_model(read_model(text, "m.json")) == text);
  }
}

TEST_CASE("The presets are files of three fields") {
  for (const char* name : {"published", "paper", "consistent"}) {
    const nlohmann::json json = nlohmann::json::parse(write_model(model_named(name)));
    CHECK(json == nlohmann::json{{"schema", "diabolo.model/1"}, {"name", name}, {"base", name}});
  }
}

TEST_CASE("What a file leaves out is as in the base, and its name is the file's") {
  const Model model = read_model(R"({"schema": "diabolo.model/1", "base": "paper"})", "some/where/mine.json");
  CHECK(model.name == "mine");
  Model paper = paper_model();
  paper.name = "mine";
  CHECK(same(model, paper));
}

TEST_CASE("A file changes what it names") {
  const Model model = read_model(file_with(R"(, "name": "stretchy",
      "parameters": {"string_length": 1.4, "gravity": 9.8}, "rules": {"spin_rule": "length_change", "planar": true,
      "plane_normal": [0, 0.6, 0.8]}, "effects": {"string_elasticity": {"stiffness": 600, "damping": 2}},
      "interpolation": "linear")"),
                                 "m.json");
  CHECK(model.name == "stretchy");
  CHECK(model.parameters.string_length == 1.4);
  CHECK(model.own_string_length);
  CHECK(!model.own_mass);
  CHECK(model.parameters.gravity == 9.8);
  CHECK(model.parameters.pull.spin_rule == SpinRule::kLengthChange);
  CHECK(model.parameters.planar);
  CHECK(model.parameters.plane_normal == Vector3<double>(0.0, 0.6, 0.8));
  CHECK(model.effects.get<StringElasticity>().compliance_per_newton == 1.0 / 600.0);
  CHECK(model.effects.get<StringElasticity>().damping == 2.0);
  CHECK(model.interpolation == Interpolation::kLinear);
}

TEST_CASE("A file says what the recording decides") {
  const auto read = [](const std::string& fields) { return read_model(file_with(fields), "m.json"); };
  CHECK(read(R"(, "parameters": {"mass": 0.3})").own_mass);
  CHECK(!read(R"(, "parameters": {"mass": 0.3}, "from_recording": ["mass"])").own_mass);
  CHECK(read(R"(, "from_recording": ["mass"])").own_string_length);
  CHECK(read(R"(, "from_recording": [])").own_axle_radius);
  CHECK(!read("").own_axle_radius);
}

TEST_CASE("A compliance whose inverse is no double is written as it is") {
  Model model = consistent_model();
  int without_stiffness = 0;
  Random random(5);
  for (int k = 0; k < 200; ++k) {
    const double compliance = random.uniform(1e-4, 1e-2);
    model.effects.get<StringElasticity>().compliance_per_newton = compliance;
    const nlohmann::json own = nlohmann::json::parse(write_model(model))["effects"]["string_elasticity"];
    REQUIRE(own.size() == 1);
    without_stiffness += own.contains("compliance") ? 1 : 0;
  }
  CHECK(without_stiffness > 0);
  CHECK(without_stiffness < 200);
}

TEST_CASE("Every fault of a model file is said with file, field, what was found and what was expected") {
  CHECK(model_complaint("{") == "m.json, line 1, column 2: this is not JSON (or the file is cut off)");
  CHECK(model_complaint("[]") == "m.json: the file is of type array; expected an object");
  CHECK(model_complaint("{}") == "m.json: field \"schema\" is missing");
  CHECK(model_complaint(R"({"schema": "diabolo.model/2", "base": "paper"})") ==
        "m.json: field \"schema\" is \"diabolo.model/2\"; expected \"diabolo.model/1\"");
  CHECK(model_complaint(R"({"schema": "diabolo.model/1"})") == "m.json: field \"base\" is missing");
  for (const char* base : {"\"mine\"", "7", "[\"paper\"]"})
    CHECK(model_complaint(std::string(R"({"schema": "diabolo.model/1", "base": )") + base + "}")
              .ends_with("expected \"consistent\", \"paper\" or \"published\""));
  const std::vector<std::pair<const char*, const char*>> faults{
      {R"(, "colour": 1)", "unknown field \"colour\""},
      {R"(, "name": "")", "field \"name\" is \"\"; expected a text that is not empty"},
      {R"(, "parameters": [])", "\"parameters\" is of type array; expected an object"},
      {R"(, "parameters": {"length": 1})", "unknown field \"parameters.length\""},
      {R"(, "parameters": {"string_length": -1})",
       "field \"parameters.string_length\" is -1; expected a number within [0.05, 20] m"},
      {R"(, "parameters": {"mass": "heavy"})", "field \"parameters.mass\" is \"heavy\"; expected a number"},
      {R"(, "parameters": {"gravity": null})",
       "field \"parameters.gravity\" is of type null; expected a number"},
      {R"(, "parameters": {"spin_coupling": 1000, "reference_step": 0.1})",
       "spin_coupling: times reference_step must not exceed 1"},
      {R"(, "rules": {"flight_rule": "soft"})",
       "field \"rules.flight_rule\" is \"soft\"; expected \"published\", \"paper\" or \"slack\""},
      {R"(, "rules": {"per_step": 1})", "field \"rules.per_step\" is 1; expected true or false"},
      {R"(, "rules": {"plane_normal": [1, 1, 0]})",
       "field \"rules.plane_normal\" is of type array; expected a direction [x, y, z] of norm 1"},
      {R"(, "rules": {"gravity": 9})", "unknown field \"rules.gravity\""},
      {R"(, "effects": {"magnus": {}})", "unknown field \"effects.magnus\""},
      {R"(, "effects": {"string_elasticity": {"stiffness": 0}})",
       "field \"effects.string_elasticity.stiffness\" is 0; expected a number within [1, 1e+09] N/m"},
      {R"(, "effects": {"string_elasticity": {"stiffness": 1, "compliance": 1}})",
       "field \"effects.string_elasticity.compliance\" is 1; expected no such field beside \"stiffness\""},
      {R"(, "effects": {"string_elasticity": {"length": 1}})",
       "unknown field \"effects.string_elasticity.length\""},
      {R"(, "interpolation": "cubic")",
       "field \"interpolation\" is \"cubic\"; expected \"held\", \"linear\" or \"spline\""},
      {R"(, "from_recording": ["gravity"])",
       "field \"from_recording\" is of type array; expected a list of \"string_length\", \"mass\" and "
       "\"axle_radius\", or of some of them"}};
  for (const auto& [fields, expected] : faults)
    CHECK(model_complaint(file_with(fields)) == "m.json: " + std::string(expected));
}

TEST_CASE("A model that no file can hold is refused, and a file appears whole or not at all") {
  Model model = consistent_model();
  model.name = "";
  CHECK_THROWS_WITH(write_model(model), "name: empty; a model in a file needs one");
  model.name = "\xff";
  CHECK(complaint([&] { write_model(model); }) == "model: a text is not UTF-8");
  model.name = "mine";
  model.parameters.gravity = kNaN;
  CHECK_THROWS_AS(write_model(model), std::invalid_argument);
  const test::TemporaryFolder folder;
  CHECK_THROWS_AS(save_model(model, folder / "m.json"), std::invalid_argument);
  CHECK(folder.entries() == 0);
  save_model(paper_model(), folder / "m.json");
  CHECK(same(load_model(folder / "m.json"), paper_model()));
}

TEST_CASE("A residual survives the model's file bit for bit, and its faults are told") {
  ResidualLaw law;
  law.largest = 1.0 / 3.0;
  law.power = 0.7;
  law.on_string.weights[4] = -1.0 / 7.0;
  law.off_string.low[3] = -0.1;
  law.off_string.high[3] = 1e-9;
  Model model = consistent_model();
  model.effects.get<ResidualForce>() = ResidualForce<double>(law);
  const std::string text = write_model(model);
  CHECK(*read_model(text, "m.json").effects.get<ResidualForce>().law == law);
  const auto changed = [&](const char* pointer, const nlohmann::json& value) {
    nlohmann::json json = nlohmann::json::parse(text);
    json[nlohmann::json::json_pointer(pointer)] = value;
    return complaint([&] { read_model(json.dump(), "m.json"); });
  };
  CHECK(changed("/residual/largest", 21).starts_with("m.json: field \"residual.largest\" is 21"));
  CHECK(changed("/residual/on_string/weights", {1.0, 2.0}).find("expected a list of 25 numbers") !=
        std::string::npos);
  CHECK(changed("/residual/on_string/high/0", -1.0).find("no number below that of \"low\"") !=
        std::string::npos);
  CHECK(changed("/residual/size", 1) == "m.json: unknown field \"residual.size\"");
}
