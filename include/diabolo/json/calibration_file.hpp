// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/json/fields.hpp"
#include "diabolo/json/properties.hpp"
#include "diabolo/recording/formats/calibration.hpp"
#include "diabolo/text/file.hpp"

namespace diabolo {

/// Reads the text of a calibration file, schema diabolo.calibration/1:
///   {"schema": "diabolo.calibration/1",
///    "left": {"body": "stick_left", "point": [x, y, z]}, "right": {...},
///    "diabolo": {"body": "diabolo_red", "point": [x, y, z], "axis": [x, y, z]},
///    "world": {"yaw_deg": -90, "offset": [x, y, z]}}
/// with points [m] and axes (of any length) in the rigid bodies' frames; "body" may be a list of names tried
/// in order. These may be left out: "axis" of a stick (then stick_axis_towards() its tip), "string_length"
/// [m], and "properties" of the diabolo (then the published ones of the red diabolo are assumed). Throws
/// RecordingError with file and field about unknown, missing and wrong fields.
inline Calibration read_calibration(std::string_view text, const std::string& file_name) {
  const nlohmann::json json = parse_json(text, file_name);
  const JsonFields file(json, file_name);
  file.expect_text("schema", "diabolo.calibration/1");
  file.expect_only({"schema", "left", "right", "diabolo", "world", "string_length"});
  const auto axis = [](const JsonFields& fields) {
    const Eigen::Vector3d direction = fields.vector3("axis");
    if (!(direction.norm() > 1e-6 && direction.norm() < 1e6))
      fields.fail("axis", "a direction of usable length");
    return Eigen::Vector3d(direction.normalized());
  };
  const auto stick = [&](const char* name) {
    const JsonFields fields = file.object(name);
    fields.expect_only({"body", "point", "axis"});
    const Eigen::Vector3d point = fields.vector3("point");
    return BodyPoint{fields.names("body"), point,
                     fields.has("axis") ? axis(fields) : stick_axis_towards(point)};
  };
  const JsonFields diabolo = file.object("diabolo"), world = file.object("world");
  diabolo.expect_only({"body", "point", "axis", "properties"});
  world.expect_only({"yaw_deg", "offset"});

  Calibration result;
  result.left = stick("left");
  result.right = stick("right");
  result.diabolo = {diabolo.names("body"), diabolo.vector3("point"), axis(diabolo)};
  result.world_yaw = world.number("yaw_deg") * std::numbers::pi / 180.0;
  result.world_offset = world.vector3("offset");
  if (diabolo.has("properties")) {
    diabolo.object("properties").expect_only({"mass", "diameter", "length", "axle_radius"});
    result.properties = properties_from_json(diabolo.object("properties"));
  }
  if (file.has("string_length")) result.string_length = file.positive("string_length");
  if (!file.has("string_length")) result.assumed.push_back("string_length");
  if (!diabolo.has("properties")) result.assumed.push_back("diabolo");
  check_calibration(result, file_name);
  return result;
}

/// Reads a calibration file; see read_calibration().
inline Calibration load_calibration(const std::filesystem::path& path) {
  return read_calibration(read_file(path), path.string());
}

/// The text of a calibration file, with every optional field but what is assumed. The yaw goes through
/// degrees: it reads back within rounding. Throws RecordingError where the calibration is unusable.
inline std::string write_calibration(const Calibration& calibration) {
  check_calibration(calibration, "calibration");
  const auto vector = [](const Eigen::Vector3d& v) { return std::vector<double>{v.x(), v.y(), v.z()}; };
  const auto part = [&](const BodyPoint& point) {
    nlohmann::ordered_json json{
        {"body", point.bodies}, {"point", vector(point.point)}, {"axis", vector(point.axis)}};
    if (point.bodies.size() == 1) json["body"] = point.bodies.front();
    return json;
  };
  nlohmann::ordered_json json{{"schema", "diabolo.calibration/1"},
                              {"left", part(calibration.left)},
                              {"right", part(calibration.right)},
                              {"diabolo", part(calibration.diabolo)},
                              {"world",
                               {{"yaw_deg", calibration.world_yaw * 180.0 / std::numbers::pi},
                                {"offset", vector(calibration.world_offset)}}}};
  const auto is_told = [&](const char* what) { return std::ranges::count(calibration.assumed, what) == 0; };
  if (is_told("string_length")) json["string_length"] = calibration.string_length;
  if (is_told("diabolo")) json["diabolo"]["properties"] = to_json(calibration.properties);
  return json_text(json, "calibration");
}

/// Writes a calibration file, whole or not at all; see write_calibration().
inline void save_calibration(const Calibration& calibration, const std::filesystem::path& path) {
  FilesToWrite files;
  files.add(path, write_calibration(calibration));
  files.commit();
}

}  // namespace diabolo
