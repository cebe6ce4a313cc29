// SPDX-License-Identifier: MIT
#include "diabolo/json/laws.hpp"

#include "catch.hpp"
#include "diabolo/json/model_file.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

namespace {

const std::string kCreep =
    R"([{"name": "creep", "acts": "string", "formula": "rate * t ^ p", "numbers": [{"name": "rate", "unit": "m/s",
    "value": 0.002}, {"name": "p", "usual": 0.5, "expected": 1.25, "minimum": 0, "maximum": 4}]}])";

std::string laws_complaint(const std::string& text) {
  return complaint([&] { read_laws(text, "l.json"); });
}

}  // namespace

TEST_CASE("laws read back as they were written, alone and in a model's file") {
  const FormulaLaws<double> laws = read_laws(kCreep, "l.json");
  CHECK(laws.numbers[0] == 0.002);
  CHECK(laws.numbers[1] == 1.25);  // as expected
  const FormulaLaws<double> again = read_laws(write_laws(laws), "l.json");
  CHECK(same_laws(laws, again));
  CHECK(laws.numbers == again.numbers);
  Model model = consistent_model();
  model.effects.get<FormulaLaws>() = laws;
  const Model read = read_model(write_model(model), "m.json");
  CHECK(same_laws(laws, read.effects.get<FormulaLaws>()));
  CHECK(read.effects.get<FormulaLaws>().numbers == laws.numbers);
}

TEST_CASE("what is no law is told with its file and field") {
  CHECK(laws_complaint(R"({"schema": "diabolo.laws/1", "laws": 3})") ==
        "l.json: field \"laws\" is 3; expected a list");
  CHECK(laws_complaint(R"([3])") == "l.json: \"laws[0]\" is 3; expected an object");
  CHECK(laws_complaint(R"([{"name": "a"}])") == "l.json: field \"laws[0].numbers\" is missing");
  CHECK(laws_complaint(R"([{"name": "a", "numbers": [{"name": "k"}], "formula": "k"}])") ==
        "l.json: field \"laws[0].acts\" is missing");
  CHECK(laws_complaint(R"([{"name": "a", "numbers": [{"name": "k"}], "formula": "k", "acts": "down"}])")
            .starts_with("l.json: field \"laws[0].acts\" is \"down\"; expected \"forward\", \"left\""));
  CHECK(laws_complaint(R"([{"name": "a", "numbers": [{"name": "k"}], "formula": "k *", "acts": "up"}])") ==
        "l.json: law \"a\": formula \"k *\", character 4: it ends; expected a number, a name or \"(\"");
  CHECK(
      laws_complaint(
          R"([{"name": "a", "numbers": [{"name": "k", "maximum": 1, "value": 2}], "formula": "k", "acts": "up"}])")
          .starts_with("l.json: laws k"));
  CHECK(laws_complaint(
            R"([{"name": "a", "numbers": [{"name": "k", "size": 2}], "formula": "k", "acts": "up"}])") ==
        "l.json: unknown field \"laws[0].numbers[0].size\"");
}
