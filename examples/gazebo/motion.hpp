// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/json/recording_file.hpp"
#include "diabolo/sticks.hpp"
#include "diabolo/text/csv.hpp"

namespace diabolo_gazebo {

/// A diabolo as it was recorded at a time [s].
struct Start {
  double time;
  diabolo::State<double> state;
};

/// What `diabolo motion` writes: the stick tips, and starts along the way.
struct Motion {
  diabolo::TipMotion<double> tips;
  std::vector<Start> starts;  ///< one at least; their times increase, and lie within the motion
  diabolo::TidyMetadata told;
};

/// The columns of a MOTION.csv.
inline constexpr std::array<std::string_view, 7> kMotionColumns{"time",    "left_x",  "left_y", "left_z",
                                                                "right_x", "right_y", "right_z"};

inline constexpr double kFastest = 1e3, kMostSpin = 1e4;  ///< of a start [m/s], [rad/s]

inline diabolo::TipMotion<double> read_tips(const std::filesystem::path& path) {
  const std::string text = diabolo::read_file(path);
  diabolo::CsvReader csv(text, path.string());
  if (!std::ranges::equal(csv.next_cells(), kMotionColumns))
    csv.fail("other columns; expected time,left_x,left_y,left_z,right_x,right_y,right_z");
  std::vector<double> times, row(kMotionColumns.size());
  std::vector<diabolo::Vector3<double>> left, right;
  while (!csv.at_end()) {
    csv.next_numbers(row);
    if (std::ranges::any_of(row, [](double number) { return std::isnan(number); }))
      csv.fail("an empty cell; expected a number");
    if (std::any_of(row.begin() + 1, row.end(),
                    [](double place) { return std::abs(place) > diabolo::kLargestCoordinate; }))
      csv.fail("a tip is farther than 100 m; expected metres");
    if (!times.empty() && !(row[0] > times.back()))
      csv.fail("time " + diabolo::shown(row[0]) + " s does not come after " + diabolo::shown(times.back()) +
               " s");
    times.push_back(row[0]);
    left.emplace_back(row[1], row[2], row[3]);
    right.emplace_back(row[4], row[5], row[6]);
  }
  if (times.size() < 2) csv.fail("the file ends here; expected two lines of data");
  return {std::move(times), left, right, diabolo::Interpolation::kSpline};
}

/// Reads MOTION.csv, and MOTION.json beside it. Throws diabolo::RecordingError with file, line or field.
inline Motion load_motion(const std::filesystem::path& path) {
  Motion motion{read_tips(path), {}, {}};
  const std::filesystem::path beside = std::filesystem::path(path).replace_extension(".json");
  const std::string file = beside.string(), text = diabolo::read_file(beside);
  motion.told = diabolo::read_metadata(text, file);
  const nlohmann::json json = diabolo::parse_json(text, file);
  const nlohmann::json& starts = diabolo::JsonFields(json, file).list("starts");
  double last = motion.tips.begin();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::string name = "starts[" + std::to_string(i) + "].";
    const diabolo::JsonFields fields(starts[i], file, name);
    Start start{fields.number("time"), {}};
    if (!(start.time >= last && start.time < motion.tips.end()))
      fields.fail("time", "one after the start before it and within the motion, of " +
                              diabolo::shown(motion.tips.begin()) + " to " +
                              diabolo::shown(motion.tips.end()) + " s");
    last = start.time;
    start.state.position = fields.vector3("position");
    start.state.velocity = fields.vector3("velocity");
    start.state.spin = fields.number("spin");
    if (start.state.position.cwiseAbs().maxCoeff() > diabolo::kLargestCoordinate ||
        start.state.velocity.cwiseAbs().maxCoeff() > kFastest || std::abs(start.state.spin) > kMostSpin)
      throw diabolo::RecordingError(file + ": " + name.substr(0, name.size() - 1) +
                                    ": farther than 100 m, faster than 1000 m/s or than 10000 rad/s; "
                                    "expected SI units");
    motion.starts.push_back(start);
  }
  if (motion.starts.empty()) throw diabolo::RecordingError(file + ": no starts; expected one at least");
  return motion;
}

}  // namespace diabolo_gazebo
