// SPDX-License-Identifier: MIT
#include "recording.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "scenario.hpp"
#include "support.hpp"

using namespace plant;

namespace {

const std::filesystem::path kFolder = DIABOLO_PLANT_RECORDINGS;
const std::vector<std::string> kNames{"circular_acceleration", "drop_and_catch", "hold", "hop",
                                      "linear_acceleration",   "swing",          "throw"};

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  REQUIRE(in);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

Scenario scenario_of(const std::string& name) { return load_scenario(kFolder / (name + ".scenario.json")); }

std::vector<Moment> moments_of(const Scenario& scenario) {
  return simulate(Plant(scenario.plant, scenario.motion), scenario.start,
                  diabolo_times(scenario.camera, scenario.duration));
}

double spin_gain(const std::string& name) {
  const Scenario scenario = scenario_of(name);
  const std::vector<Moment> moments = moments_of(scenario);
  return play_spin(scenario.plant.diabolo, moments.back().state) -
         play_spin(scenario.plant.diabolo, moments.front().state);
}

std::set<Mode> modes(const std::vector<Moment>& moments) {
  std::set<Mode> seen;
  for (const Moment& moment : moments) seen.insert(moment.mode);
  return seen;
}

}  // namespace

TEST_CASE("each shipped recording comes out of its scenario byte for byte") {
  for (const std::string& name : kNames) {
    CAPTURE(name);
    const Scenario scenario = scenario_of(name);
    const std::vector<Frame> frames =
        film(scenario.camera, scenario.motion, moments_of(scenario), scenario.seed);
    std::ostringstream table;
    write_frames(table, frames, scenario.camera.stick_orientation);
    std::ostringstream description;
    write_description(description, scenario.plant.diabolo,
                      scenario.plant.string.length + scenario.string_length_error, scenario.camera.rate);
    // Compared as truth values: a failure prints no megabytes.
    CHECK((table.str() == content(kFolder / (name + ".csv"))));
    CHECK((description.str() == content(kFolder / (name + ".json"))));
  }
}

TEST_CASE("the diabolo stays in play through every shipped recording, tips nearer than the string is long") {
  for (const std::string& name : kNames) {
    CAPTURE(name);
    const Scenario scenario = scenario_of(name);
    const std::vector<Moment> moments = moments_of(scenario);
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
  CHECK(modes(moments_of(scenario_of("hold"))) == std::set<Mode>{kOnString});
  CHECK(modes(moments_of(scenario_of("swing"))) == std::set<Mode>{kOnString});
  CHECK(modes(moments_of(scenario_of("hop"))) == std::set<Mode>{kOnString, kLoose});
  for (const char* name : {"throw", "drop_and_catch"}) {
    const std::vector<Moment> moments = moments_of(scenario_of(name));
    CHECK(modes(moments) == std::set<Mode>{kOnString, kLoose, kFlying});
    CHECK(moments.back().mode == kOnString);
  }
  CHECK(spin_gain("hold") < -80.0);
  CHECK(spin_gain("linear_acceleration") > 30.0);
  CHECK(spin_gain("circular_acceleration") > 10.0);
}
