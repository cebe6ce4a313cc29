// SPDX-License-Identifier: MIT
#include "diabolo/json/diagnosis_file.hpp"

#include <fstream>
#include <iterator>

#include "catch.hpp"
#include "source_dir.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

DiagnosisResult example() {
  DiagnosisResult result;
  result.headline = "NAMED";
  ClaimedEffect effect;
  effect.name = "magnus_lift";
  effect.parameters = {Estimate{"coefficient", 0.003, "1/rad", Interval{0.002, 0.004}}};
  effect.where.intervals = {{1.0, 2.5}};
  effect.worse_without_ci95_m = {std::nullopt, Interval{0.01, 0.02}};
  result.effects = {effect};
  UnnamedStructure unnamed;
  unnamed.curve = {{1.0, 2.0}, {3.0, 4.0}};
  result.unnamed = {unnamed};
  result.fit.windows = 7;
  result.model = "model.json";
  return result;
}

}  // namespace

TEST_CASE("a diagnosis that is written is read again, and numbers that are none are null") {
  const std::string text = write_diagnosis(example());
  const DiagnosisResult again = read_diagnosis(text, "d.json");
  CHECK(write_diagnosis(again) == text);
  CHECK(again.effects.at(0).parameters.at(0).ci90->high == 0.004);
  CHECK_FALSE(again.effects[0].worse_without_ci95_m.at(0));
  CHECK(again.unnamed.at(0).curve.at(1)[1] == 4.0);
  CHECK(std::isnan(again.unnamed[0].value));
  CHECK(again.fit.windows == 7);
  CHECK(again.model == "model.json");
  CHECK_FALSE(again.seconds);
  CHECK(again.thresholds.physics == kSignificance);
  CHECK(again.thresholds.numerical_share == kNumericalShare);
}

TEST_CASE("what a diagnosis' file holds in the wrong place is named") {
  const auto read = [](const std::string& parts) {
    return read_diagnosis(R"({"schema": "diabolo.diagnosis/1", )" + parts + "}", "d.json");
  };
  CHECK(read(R"("headline": "TIE")").headline == "TIE");
  CHECK_THROWS_WITH(read(R"("ladder": [{"z": "four"}])"),
                    Contains("d.json: ladder[0], z: \"four\"; expected a number"));
  CHECK_THROWS_WITH(read(R"("fit": {"improvement_ci95_m": [[1, 2, 3]]})"),
                    Contains("fit, improvement_ci95_m[0]: [1,2,3]; expected two numbers"));
  CHECK_THROWS_WITH(read_diagnosis("{}", "d.json"), Contains("\"schema\" is missing"));
}

TEST_CASE("the schema that is committed is that of what is written") {
  std::ifstream file(source_dir() / "docs/diagnosis.schema.json");
  const std::string committed{std::istreambuf_iterator<char>(file), {}};
  CHECK(nlohmann::json::parse(committed) == nlohmann::json::parse(diagnosis_schema()));
  const auto schema = nlohmann::json::parse(committed);
  const auto written = nlohmann::json::parse(write_diagnosis(example()));
  for (const auto& name : schema.at("required")) CHECK(written.contains(name));
  CHECK(written.size() == schema.at("properties").size());
}
