// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "../../../tests/catch.hpp"

namespace {

const std::filesystem::path kFolder = std::filesystem::path(DIABOLO_PLANT_SCRATCH);

constexpr const char* kMinimal = R"({"schema": "diabolo.scenario/1",
  "motion": {"elements": [{"type": "hold", "duration": 0.2}]}})";

struct Outcome {
  int status;
  std::string errors;
};

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// An empty folder with a scenario in it.
void prepare(const std::string& scenario) {
  std::filesystem::remove_all(kFolder);
  std::filesystem::create_directories(kFolder);
  std::ofstream(kFolder / "a.scenario.json") << scenario;
}

/// Runs the program in the folder.
Outcome run(const std::string& arguments) {
  const std::string command =
      "cd '" + kFolder.string() + "' && '" DIABOLO_PLANT_PROGRAM "' " + arguments + " >/dev/null 2>errors";
  const int status = std::system(command.c_str());
  const Outcome outcome{(status >> 8) & 0xff, content(kFolder / "errors")};
  std::filesystem::remove(kFolder / "errors");
  return outcome;
}

std::ptrdiff_t files() { return std::distance(std::filesystem::directory_iterator(kFolder), {}); }

/// Expects a refusal in one sentence, which holds `part`, and no file written.
void expect_refusal(const std::string& scenario, const std::string& arguments, const std::string& part) {
  prepare(scenario);
  const Outcome outcome = run(arguments);
  INFO(outcome.errors);
  CHECK(outcome.status == 2);
  CHECK(outcome.errors.rfind("diabolo-plant: ", 0) == 0);
  CHECK(outcome.errors.find(part) != std::string::npos);
  CHECK(outcome.errors.find('\n') == outcome.errors.size() - 1);
  CHECK(files() == 1);
}

}  // namespace

TEST_CASE("a scenario becomes a recording, its description and the truth, and nothing else") {
  prepare(kMinimal);
  const Outcome outcome = run("a.scenario.json --out a.csv --truth truth.csv");
  CHECK(outcome.status == 0);
  CHECK(outcome.errors.empty());
  CHECK(files() == 4);
  const std::string table = content(kFolder / "a.csv");
  CHECK(std::count(table.begin(), table.end(), '\n') == 1 + 25);
  const std::string truth = content(kFolder / "truth.csv");
  CHECK(std::count(truth.begin(), truth.end(), '\n') == 1 + 241);
  CHECK(run("a.scenario.json --out b.csv").status == 0);
  CHECK(content(kFolder / "b.csv") == table);
  CHECK(run("a.scenario.json --out b.csv --seed 5").status == 0);
  CHECK(content(kFolder / "b.csv") != table);
}

TEST_CASE("bad input is refused in one sentence and with status 2") {
  const std::string normal = "a.scenario.json --out a.csv";
  expect_refusal("{", normal, "a.scenario.json: not JSON");
  expect_refusal("", normal, "a.scenario.json: not JSON");
  expect_refusal("[]", normal, "expected an object");
  expect_refusal("{}", normal, "schema: found \"\"");
  expect_refusal(kMinimal, "none.json --out a.csv", "none.json: cannot be read");
  expect_refusal(kMinimal, "a.scenario.json --out a.txt", "expected NAME.csv");
  expect_refusal(kMinimal, "a.scenario.json --out a.scenario.csv", "would overwrite a.scenario.json");
  expect_refusal(kMinimal, "a.scenario.json --out ./a.scenario.csv", "would overwrite a.scenario.json");
  expect_refusal(kMinimal, "a.scenario.json --out a.csv --truth a.json", "--truth: a.json would overwrite");

  const std::string begin = R"({"schema": "diabolo.scenario/1", )";
  const std::string motion = R"("motion": {"elements": [{"type": "hold", "duration": 0.2}]}})";
  expect_refusal(begin + R"("string": {"stiffness": 1e999}, )" + motion, normal, "not JSON");
  expect_refusal(begin + R"("gravity": [0, 0, 1e30], )" + motion, normal, "gravity: found 1e+30");
  expect_refusal(
      begin + R"("motion": {"left": [0, 2, 1.25], "elements": [{"type": "hold", "duration": 0.2}]}})", normal,
      "expected less than the string's length");
  expect_refusal(begin + R"("motion": {"elements": [{"type": "repeat", "count": 1000, "elements": [
                   {"type": "hold", "duration": 600}]}]}})",
                 normal, "lasts more than an hour");
  expect_refusal(begin + R"("steps_per_second": 1000, "string": {"stiffness": 1e6}, )" + motion, normal,
                 "too few steps per second");
  expect_refusal(
      begin + R"("start": {"position": [0, 9, 1], "flying": true}, "camera": {"diabolo_delay": -1}, )" +
          motion,
      normal, "misses the string before the first frame");
}

TEST_CASE("wrong use is refused with status 2, a file that cannot be written with status 1") {
  prepare(kMinimal);
  CHECK(run("").status == 2);
  CHECK(run("").errors == "diabolo-plant: scenario is required; see --help\n");
  CHECK(run("a.scenario.json").status == 2);
  CHECK(run("a.scenario.json --out a.csv --sed 3").status == 2);
  CHECK(run("a.scenario.json --out none/a.csv").status == 1);
  CHECK(run("--help").status == 0);
  CHECK(files() == 1);
}
