// SPDX-License-Identifier: MIT
#include "recording.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "key.hpp"
#include "support.hpp"
#include "take.hpp"

using namespace plant;

namespace {

const std::filesystem::path kFolder = DIABOLO_PLANT_RECORDINGS;
const std::vector<std::string> kPuzzles{"puzzle_1", "puzzle_2"};
const std::vector<std::string> kNames{"circular_acceleration",
                                      "drop_and_catch",
                                      "hold",
                                      "hop",
                                      "linear_acceleration",
                                      "puzzle_1",
                                      "puzzle_2",
                                      "swing",
                                      "throw"};

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  REQUIRE(in);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

const Scenario& scenario_of(const std::string& name) {
  static std::map<std::string, Scenario> known;
  const auto found = known.find(name);
  if (found != known.end()) return found->second;
  return known.emplace(name, load_scenario(kFolder / (name + ".scenario.json"))).first->second;
}

/// Each scenario is played once for all tests.
const std::vector<Moment>& moments_of(const std::string& name) {
  static std::map<std::string, std::vector<Moment>> known;
  const auto found = known.find(name);
  if (found != known.end()) return found->second;
  return known.emplace(name, take(scenario_of(name), false).filmed).first->second;
}

double spin_gain(const std::string& name) {
  const DiaboloParameters& diabolo = scenario_of(name).plant.diabolo;
  const std::vector<Moment>& moments = moments_of(name);
  return play_spin(diabolo, moments.back().state) - play_spin(diabolo, moments.front().state);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

/// Where two tables part: other columns, rows or lost frames, or numbers further apart than `tolerance`;
/// empty when they agree.
std::string first_difference(const std::string& one, const std::string& other, double tolerance) {
  const std::vector<std::string> rows = split(one, '\n');
  const std::vector<std::string> other_rows = split(other, '\n');
  if (rows.size() != other_rows.size() || rows.empty()) return "number of rows";
  if (rows[0] != other_rows[0]) return "columns";
  for (std::size_t row = 1; row < rows.size(); ++row) {
    // A trailing comma stands for an empty last cell.
    const std::vector<std::string> cells = split(rows[row] + ",", ',');
    const std::vector<std::string> other_cells = split(other_rows[row] + ",", ',');
    if (cells.size() != other_cells.size()) return "number of cells in row " + std::to_string(row);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i] == other_cells[i]) continue;
      const bool lost = cells[i].empty() || other_cells[i].empty();
      if (lost || !(std::abs(std::stod(cells[i]) - std::stod(other_cells[i])) <= tolerance)) {
        return "row " + std::to_string(row) + ", column " + std::to_string(i) + ": '" + cells[i] + "' and '" +
               other_cells[i] + "'";
      }
    }
  }
  return "";
}

std::set<Mode> modes(const std::vector<Moment>& moments) {
  std::set<Mode> seen;
  for (const Moment& moment : moments) seen.insert(moment.mode);
  return seen;
}

}  // namespace

// Bytes are equal on every processor tried, but libm may differ in the last bit between two of them, and a
// number that lies between two printed ones may then be printed as the other.
TEST_CASE("each shipped recording comes out of its scenario to one unit of its last digit") {
  constexpr double kLastDigit = 1.001e-6;
  for (const std::string& name : kNames) {
    CAPTURE(name);
    const Scenario& scenario = scenario_of(name);
    std::ostringstream table;
    write_frames(table, film(scenario.camera, scenario.motion, moments_of(name), scenario.seed),
                 scenario.camera.stick_orientation);
    std::ostringstream description;
    write_description(description, scenario);
    const std::string shipped = content(kFolder / (name + ".csv"));
    CHECK(first_difference(table.str(), shipped, kLastDigit) == "");
    CHECK(description.str() == content(kFolder / (name + ".json")));
    if (table.str() != shipped) WARN(name << ": equal to the last digit, but not byte for byte");
  }
}

TEST_CASE("the shipped keys tell what is at work in the puzzles") {
  for (const std::string& name : kPuzzles) {
    CAPTURE(name);
    std::ostringstream key;
    write_key(key, scenario_of(name));
    CHECK(key.str() == content(kFolder / (name + ".key.json")));
  }
}

TEST_CASE("tables that differ are told apart") {
  const std::string table = "time,x\n0.000000,1.000000\n0.008333,\n";
  CHECK(first_difference(table, table, 1e-6) == "");
  CHECK(first_difference(table, "time,x\n0.000000,1.000001\n0.008333,\n", 1.001e-6) == "");
  CHECK(first_difference(table, "time,x\n0.000000,1.000002\n0.008333,\n", 1.001e-6) != "");
  CHECK(first_difference(table, "time,x\n0.000000,1.000000\n0.008333,1.000000\n", 1e-6) != "");
  CHECK(first_difference(table, "time,x\n0.000000,1.000000\n", 1e-6) != "");
  CHECK(first_difference(table, "time,y\n0.000000,1.000000\n0.008333,\n", 1e-6) != "");
}

TEST_CASE("the diabolo stays in play through every shipped recording, tips nearer than the string is long") {
  for (const std::string& name : kNames) {
    CAPTURE(name);
    const Scenario& scenario = scenario_of(name);
    const std::vector<Moment>& moments = moments_of(name);
    CHECK(moments.size() == diabolo_times(scenario.camera, scenario.duration).size());
    CHECK(moments.back().mode != Mode::kFlying);
    for (const Moment& moment : moments) {
      const Pair<Stick> sticks = scenario.motion.at(moment.time);
      const double distance = (sticks[0].tip - sticks[1].tip).norm();
      REQUIRE(distance > 0.25);
      REQUIRE(distance < 1.3);
      REQUIRE(std::abs(moment.state(0, kAxis)) > 0.9);
    }
  }
}

TEST_CASE("each shipped recording shows what its name says") {
  using enum Mode;
  CHECK(modes(moments_of("hold")) == std::set<Mode>{kOnString});
  CHECK(modes(moments_of("swing")) == std::set<Mode>{kOnString});
  CHECK(modes(moments_of("hop")) == std::set<Mode>{kOnString, kLoose});
  CHECK(modes(moments_of("puzzle_1")) == std::set<Mode>{kOnString, kLoose});
  for (const char* name : {"throw", "drop_and_catch"}) {
    const std::vector<Moment>& moments = moments_of(name);
    CHECK(modes(moments) == std::set<Mode>{kOnString, kLoose, kFlying});
    CHECK(moments.back().mode == kOnString);
  }
  CHECK(spin_gain("hold") < -80.0);
  CHECK(spin_gain("linear_acceleration") > 30.0);
  CHECK(spin_gain("circular_acceleration") > 10.0);
}
