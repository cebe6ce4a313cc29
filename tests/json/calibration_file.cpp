// SPDX-License-Identifier: MIT
#include "diabolo/json/calibration_file.hpp"

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;
using test::replaced;

namespace {

const std::string kText = R"({"schema": "diabolo.calibration/1",
  "left": {"body": "stick_left", "point": [0.1, 0.0, 0.0]},
  "right": {"body": ["stick_right", "stick_right_2010_10"], "point": [0, 0, 0]},
  "diabolo": {"body": "diabolo_red", "point": [-0.07, -0.006, -0.013], "axis": [-2, 0, 0]},
  "world": {"yaw_deg": -90, "offset": [0.1, -0.2, 0.3]}})";

std::string calibration_complaint(const std::string& from, const std::string& to) {
  return complaint([&] { read_calibration(replaced(kText, from, to), "c.json"); });
}

void check_same(const BodyPoint& a, const BodyPoint& b) {
  CHECK(a.bodies == b.bodies);
  CHECK(a.point == b.point);
  CHECK((a.axis - b.axis).norm() < 1e-15);
}

}  // namespace

TEST_CASE("A calibration file is read as it stands") {
  const Calibration calibration = read_calibration(kText, "c.json");
  CHECK(calibration.left.bodies == std::vector<std::string>{"stick_left"});
  CHECK(calibration.left.axis == Eigen::Vector3d::UnitX());
  CHECK(calibration.right.bodies == std::vector<std::string>{"stick_right", "stick_right_2010_10"});
  CHECK(calibration.right.axis == Eigen::Vector3d::UnitX());
  CHECK(calibration.diabolo.point == Eigen::Vector3d(-0.07, -0.006, -0.013));
  CHECK(calibration.diabolo.axis == -Eigen::Vector3d::UnitX());
  CHECK(calibration.world_yaw == -std::numbers::pi / 2.0);
  CHECK(calibration.world_offset == Eigen::Vector3d(0.1, -0.2, 0.3));
  CHECK(calibration.properties.mass == kRedDiabolo.mass);
  CHECK(calibration.string_length == kPublishedStringLength);
  CHECK(calibration.assumed == std::vector<std::string>{"string_length", "diabolo"});
}

TEST_CASE("What may be left out is read where it is there") {
  std::string text = replaced(kText, "[0.1, 0.0, 0.0]", "[0.1, 0.0, 0.0], \"axis\": [0, 3, 4]");
  text = replaced(text, "\"left\"", "\"string_length\": 1.7, \"left\"");
  text = replaced(
      text, "[-2, 0, 0]",
      "[-2, 0, 0], \"properties\": {\"mass\": 1, \"diameter\": 0.2, \"length\": 0.3, \"axle_radius\": 0.04}");
  const Calibration calibration = read_calibration(text, "c.json");
  CHECK((calibration.left.axis - Eigen::Vector3d(0.0, 0.6, 0.8)).norm() < 1e-15);
  CHECK(calibration.string_length == 1.7);
  CHECK(calibration.properties.diameter == 0.2);
  CHECK(calibration.properties.axle_radius == 0.04);
  CHECK(calibration.assumed.empty());
}

TEST_CASE("Calibrations that are written read back") {
  for (const Calibration& calibration :
       {published_calibration(), blue_calibration(), read_calibration(kText, "c.json")}) {
    const Calibration read = read_calibration(write_calibration(calibration), "c.json");
    check_same(read.left, calibration.left);
    check_same(read.right, calibration.right);
    check_same(read.diabolo, calibration.diabolo);
    CHECK(read.world_yaw == Approx(calibration.world_yaw).epsilon(1e-15));
    CHECK(read.world_offset == calibration.world_offset);
    CHECK(read.string_length == calibration.string_length);
    CHECK(read.properties.mass == calibration.properties.mass);
    CHECK(read.assumed == calibration.assumed);
  }
}

TEST_CASE("Calibration files are written whole and found by their path") {
  const test::TemporaryFolder folder;
  save_calibration(blue_calibration(), folder / "blue.json");
  check_same(load_calibration(folder / "blue.json").diabolo, blue_calibration().diabolo);
  CHECK(folder.entries() == 1);
  CHECK(
      complaint([&] { load_calibration(folder / "red.json"); }).ends_with("red.json: there is no such file"));
  Calibration broken = blue_calibration();
  broken.left.bodies = {"caf\xe9"};
  CHECK(complaint([&] { save_calibration(broken, folder / "blue.json"); }) ==
        "calibration: a text is not UTF-8");
  broken.left.bodies = {};
  CHECK(complaint([&] { save_calibration(broken, folder / "blue.json"); }) ==
        "calibration: left.body is empty; expected the name of a rigid body");
  CHECK(load_calibration(folder / "blue.json").left.bodies.front() == "stick_left");
}

TEST_CASE("Unknown, missing and wrong fields are named") {
  CHECK(calibration_complaint("calibration/1", "calibration/2") ==
        "c.json: field \"schema\" is \"diabolo.calibration/2\"; expected \"diabolo.calibration/1\"");
  CHECK(calibration_complaint("\"left\"", "\"Left\"") == "c.json: unknown field \"Left\"");
  CHECK(calibration_complaint("\"left\": {\"body\": \"stick_left\", \"point\": [0.1, 0.0, 0.0]},", "") ==
        "c.json: field \"left\" is missing");
  CHECK(calibration_complaint("\"yaw_deg\"", "\"yaw\"") == "c.json: unknown field \"world.yaw\"");
  CHECK(calibration_complaint("\"yaw_deg\": -90, ", "") == "c.json: field \"world.yaw_deg\" is missing");
  CHECK(calibration_complaint("-90", "\"-90\"") ==
        "c.json: field \"world.yaw_deg\" is \"-90\"; expected a number");
  CHECK(calibration_complaint("\"stick_left\"", "7") ==
        "c.json: field \"left.body\" is 7; expected a name, or a list of names");
  CHECK(calibration_complaint("\"stick_left\"", "\"\"") ==
        "c.json: field \"left.body\" is \"\"; expected a name, or a list of names");
  CHECK(calibration_complaint("[0.1, 0.0, 0.0]", "[0.1, 0.0]") ==
        "c.json: field \"left.point\" is of type array; expected [x, y, z]");
  CHECK(calibration_complaint("[0.1, 0.0, 0.0]", "[0.1, 0.0, 1e9]") ==
        "c.json: left.point [m] must be finite and within 100 m");
  CHECK(calibration_complaint(", \"axis\": [-2, 0, 0]", "") == "c.json: field \"diabolo.axis\" is missing");
  CHECK(calibration_complaint("[-2, 0, 0]", "[0, 0, 0]") ==
        "c.json: field \"diabolo.axis\" is of type array; expected a direction of usable length");
  CHECK(calibration_complaint("[-2, 0, 0]", "[-2, 0, 0], \"properties\": {\"mass\": 0}") ==
        "c.json: field \"diabolo.properties.mass\" is 0; expected a number > 0");
  CHECK(calibration_complaint("[-2, 0, 0]", "[-2, 0, 0], \"properties\": {\"weight\": 1}") ==
        "c.json: unknown field \"diabolo.properties.weight\"");
}
