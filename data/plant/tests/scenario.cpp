// SPDX-License-Identifier: MIT
#include "scenario.hpp"

#include <filesystem>
#include <sstream>

#include "recording.hpp"
#include "support.hpp"
#include "techniques.hpp"

using namespace plant;

namespace {

Fields::Json minimal() {
  return Fields::Json::parse(R"({"schema": "diabolo.scenario/1",
                                 "motion": {"elements": [{"type": "hold", "duration": 1.0}]}})");
}

std::string message_of(const Fields::Json& json) {
  try {
    scenario_from_json(json);
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "accepted";
}

std::string message_of(const std::string& pointer, const Fields::Json& value) {
  Fields::Json json = minimal();
  json[Fields::Json::json_pointer(pointer)] = value;
  return message_of(json);
}

}  // namespace

TEST_CASE("a minimal scenario is the nominal plant") {
  const Scenario scenario = scenario_from_json(minimal());
  CHECK(scenario.duration == Approx(1.0));
  CHECK(scenario.plant.string.stiffness == StringParameters{}.stiffness);
  CHECK(scenario.plant.sticks.bending_stiffness == StickParameters{}.bending_stiffness);
}

TEST_CASE("every field that is given is used") {
  Fields::Json json = minimal();
  json["string"]["friction"] = 0.17;
  json["sticks"]["bending_stiffness"] = nullptr;
  json["diabolo"]["bearing_torque"] = 2e-4;
  json["camera"]["tilt_deg"] = 1.5;
  json["motion"]["left"] = {0.1, 0.5, 1.3};
  json["seed"] = 42;
  const Scenario scenario = scenario_from_json(json);
  CHECK(scenario.plant.string.friction == 0.17);
  CHECK_FALSE(scenario.plant.sticks.bending_stiffness.has_value());
  CHECK(scenario.plant.diabolo.bearing_torque == 2e-4);
  CHECK(scenario.camera.tilt == Approx(1.5 * kRadiansPerDegree));
  CHECK(scenario.motion.at(0.5)[0].tip == Vec3(0.1, 0.5, 1.3));
  CHECK(scenario.seed == 42);
  CHECK(scenario_from_json(json, 43).seed == 43);
}

TEST_CASE("a bad scenario is refused in one sentence that names the field") {
  CHECK(message_of(minimal()) == "accepted");
  CHECK(message_of(Fields::Json::array()) == "scenario: found [], expected an object");
  CHECK(message_of("/schema", "other") == "schema: found \"other\", expected \"diabolo.scenario/1\"");
  CHECK(message_of("/string/stiffness", -3) ==
        "string.stiffness: found -3, expected a number from 10 to 1e+06");
  CHECK(message_of("/string/stiffness", "high") ==
        "string.stiffness: found \"high\", expected a number from 10 to 1e+06");
  CHECK(message_of("/string/elasticity", 1) == "string.elasticity: unknown field");
  CHECK(message_of("/string", 1) == "string: found 1, expected an object");
  CHECK(message_of("/string/wraps", 0.5) == "string.wraps: found 0.5, expected a whole number");
  CHECK(message_of("/gravity", {0, 0}) == "gravity: found [0,0], expected three numbers");
  CHECK(message_of("/seed", -1) == "seed: found -1, expected a whole number of at least 0");
  CHECK(message_of("/camera/stick_orientation", 1) ==
        "camera.stick_orientation: found 1, expected true or false");
  CHECK(message_of("/start/flying", true) ==
        "start.position: found nothing, expected three numbers, as the start is flying or has a velocity");
  CHECK(message_of("/motion/elements/0/type", "dance").rfind("motion.elements[0].type: found \"dance\"", 0) ==
        0);
  CHECK(message_of("/motion/elements/0/duration", 0) ==
        "motion.elements[0].duration: found 0, expected a number from 0.01 to 600");
  CHECK(message_of("/motion/elements", 3) == "motion.elements: found 3, expected a list of objects");
  CHECK(message_of("/motion/elements", Fields::Json::array()) ==
        "motion.elements: found [], expected at least one element");
}

TEST_CASE("laws that no diagnosis names are read within their ranges, and a chain has no string for some") {
  Fields::Json json = minimal();
  json["air"] = Fields::Json::parse(R"({"gust": [1, 0, 0.5], "gust_frequency": 0.7, "gust_phase": 1,
    "spin_gust": 4, "constant_drag": 0.3, "drag_power": 3, "windage_power": 1.2, "tip_wake": 0.4,
    "pull": 2, "pull_centre": [0.1, 0, 1]})");
  const AirParameters air = scenario_from_json(json).plant.air;
  CHECK(air.gust == Vec3(1.0, 0.0, 0.5));
  CHECK(air.gust_frequency + air.gust_phase + air.spin_gust == Approx(5.7));
  CHECK(air.constant_drag + air.drag_power + air.windage_power + air.tip_wake + air.pull == Approx(6.9));
  CHECK(air.pull_centre == Vec3(0.1, 0.0, 1.0));
  CHECK(message_of("/string/creep", 0.002) == "accepted");
  CHECK(message_of("/diabolo/tension_drag", 0.1) == "accepted");
  CHECK(message_of("/air/gusts", 1) == "air.gusts: unknown field");
  CHECK(message_of("/air/gust", 1) == "air.gust: found 1, expected three numbers");
  CHECK(message_of("/air/drag_power", 0.5) == "air.drag_power: found 0.5, expected a number from 1 to 4");
  CHECK(message_of("/air/windage_power", 5) == "air.windage_power: found 5, expected a number from 0.5 to 4");
  CHECK(message_of("/air/constant_drag", -1) ==
        "air.constant_drag: found -1, expected a number from 0 to 100");
  CHECK(message_of("/string/creep", -0.001) == "string.creep: found -0.001, expected a number from 0 to 0.1");
  json["structure"] = "chain";
  CHECK(message_of(json) == "accepted");
  json["string"]["creep"] = 0.002;
  CHECK(message_of(json) == "string.creep: found 0.002, expected no such field for a chain");
  json.erase("string");
  json["diabolo"]["tension_drag"] = 0.1;
  CHECK(message_of(json) == "diabolo.tension_drag: found 0.1, expected no such field for a chain");
}

TEST_CASE("a path needs one offset for each rising time") {
  Fields::Json path = Fields::Json::parse(R"({"type": "path", "times": [0.5, 1.0],
    "left": [[0, 0, 0.1], [0, 0, 0]], "right": [[0, 0, 0.1], [0, 0, 0]]})");
  CHECK(message_of("/motion/elements/1", path) == "accepted");
  path["left"].erase(1);
  CHECK(message_of("/motion/elements/1", path) ==
        "motion.elements[1].left: found 1 offsets, expected 2, one for each time");
  path["left"] = path["right"];
  path["times"] = {0.5, 0.5};
  CHECK(message_of("/motion/elements/1", path) ==
        "motion.elements[1].times: found 0.500000 s at place 2, expected times above 0 s that rise");
}

TEST_CASE("a motion is twice continuously differentiable and rests at both ends") {
  Fields::Json json = minimal();
  json["motion"]["wander"] = 0.004;
  json["motion"]["wander_deg"] = 2.0;
  json["motion"]["elements"] = Fields::Json::parse(R"([
    {"type": "hold", "duration": 0.3},
    {"type": "beat", "amplitude": 0.1, "frequency": 1.6, "cycles": 2},
    {"type": "move", "duration": 0.4, "left": [0, 0.1, 0], "right": [0, -0.1, 0]},
    {"type": "stick_sweep", "yaw_deg": 40, "pitch_deg": 10, "frequency": 0.5, "cycles": 1},
    {"type": "circular_acceleration", "count": 1}])");
  const Motion motion = scenario_from_json(json).motion;
  constexpr double kStep = 1e-5;
  double largest_jump = 0.0;
  for (double time = 0.0; time < motion.duration(); time += 0.00731) {
    for (std::size_t side = 0; side < 2; ++side) {
      const Stick before = motion.at(time - kStep)[side];
      const Stick here = motion.at(time)[side];
      const Stick after = motion.at(time + kStep)[side];
      CHECK((here.velocity - (after.tip - before.tip) / (2.0 * kStep)).norm() < 1e-6);
      if (time > 2.0 * kStep && time < motion.duration() - 2.0 * kStep) {
        CHECK((here.acceleration - (after.velocity - before.velocity) / (2.0 * kStep)).norm() < 2e-2);
        largest_jump = std::max(largest_jump, (after.acceleration - before.acceleration).norm());
      }
    }
  }
  CHECK(largest_jump < 0.1);
  for (const double time : {0.0, motion.duration()}) CHECK(motion.at(time)[0].velocity.norm() < 1e-9);
}

TEST_CASE("every technique brings the hands home") {
  for (const auto& [name, technique] : techniques()) {
    CAPTURE(name);
    Fields::Json json = minimal();
    json["motion"]["elements"] =
        Fields::Json::array({{{"type", name}, {"size", 1.1}, {"pace", 0.9}, {"count", 2}}});
    const Motion motion = scenario_from_json(json).motion;
    for (std::size_t side = 0; side < 2; ++side) {
      CHECK((motion.at(motion.duration())[side].tip - motion.at(0.0)[side].tip).norm() < 1e-12);
    }
  }
}

TEST_CASE("a recording has its columns, empty cells for lost bodies and no negative zeros") {
  Frame frame;
  frame.time = 1.0 / 120.0;
  frame.sticks[0] = Pose{{-1e-9, 0.35, 1.25}, Eigen::Quaterniond::Identity()};
  std::ostringstream out;
  write_frames(out, {frame}, false);
  CHECK(out.str() ==
        "time,left_x,left_y,left_z,right_x,right_y,right_z,diabolo_x,diabolo_y,diabolo_z,"
        "diabolo_qx,diabolo_qy,diabolo_qz,diabolo_qw\n"
        "0.008333,0,0.35,1.25,,,,,,,,,,\n");
}

TEST_CASE("a file is written whole or not at all") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() /
      ("plant_test_" + std::to_string(RandomStream(1, 1).uniform_int(0, 999)));
  CHECK_THROWS_AS(write_file(folder / "none" / "a.csv", [](std::ostream& out) { out << "x"; }),
                  std::runtime_error);
  std::filesystem::create_directories(folder);
  write_file(folder / "a.csv", [](std::ostream& out) { out << "x"; });
  CHECK(std::filesystem::file_size(folder / "a.csv") == 1);
  CHECK_THROWS_AS(write_file(folder / "b.csv", [](std::ostream& out) { out.setstate(std::ios::failbit); }),
                  std::runtime_error);
  CHECK(std::distance(std::filesystem::directory_iterator(folder), {}) == 1);
  std::filesystem::remove_all(folder);
}
