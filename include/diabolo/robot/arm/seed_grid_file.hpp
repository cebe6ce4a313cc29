// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/robot/arm/ik_seed_grid.hpp"
#include "diabolo/text/csv.hpp"
#include "diabolo/text/file.hpp"

namespace diabolo {

/// First line of a seed grid's file.
inline constexpr std::string_view kSeedGridColumns = "x,y,z,q1,q2,q3,q4,q5,q6";

/// The text of a seed grid: one key point a line, its place [m, world] and its joints [rad], z running first
/// and x last, numbers in their shortest form that reads back as the same double.
inline std::string write_seed_grid(const IkSeedGrid& grid) {
  const GridBox& box = grid.box();
  std::string text = std::string(kSeedGridColumns) + "\n";
  for (int x = 0; x < box.knots[0]; ++x)
    for (int y = 0; y < box.knots[1]; ++y)
      for (int z = 0; z < box.knots[2]; ++z) {
        const Vector3<double> point = box.knot(x, y, z);
        text += shown(point.x()) + "," + shown(point.y()) + "," + shown(point.z());
        for (const double angle : grid.joints()[box.place(x, y, z)]) text.append(",").append(shown(angle));
        text += "\n";
      }
  return text;
}

/// No joint of an arm turns farther than a little more than once [rad].
inline constexpr double kMostAngle = 7.0;

/// Reads the text of write_seed_grid(). Throws RecordingError with the line, what was found and what was
/// expected.
inline IkSeedGrid read_seed_grid(std::string_view text, const std::string& file_name,
                                 GridInterpolation interpolation = GridInterpolation::kCubic) {
  CsvReader csv(text, file_name);
  const std::string_view header = csv.next_line();
  if (header != kSeedGridColumns)
    csv.fail(shown(header) + "; expected the columns " + std::string(kSeedGridColumns));
  csv.drop_blank_end();
  std::vector<Vector3<double>> points;
  std::vector<Joints<double>> joints;
  std::vector<double> row(9);
  const auto is_missing = [](double number) { return std::isnan(number); };
  while (!csv.at_end()) {
    csv.next_numbers(row);
    if (std::ranges::any_of(row, is_missing)) csv.fail("an empty cell; expected a number in each");
    points.emplace_back(row[0], row[1], row[2]);
    joints.emplace_back(Eigen::Map<const Joints<double>>(row.data() + 3));
  }
  if (points.empty()) throw RecordingError(file_name + ": no key points; expected eight or more");
  // z runs first: a coordinate's count is how often it changes before the next one does.
  GridBox box;
  box.lower = points.front();
  box.upper = points.back();
  const auto run = [&](int axis) {
    std::size_t length = 1;
    while (length < points.size() && points[length][axis] == points[0][axis]) ++length;
    return length;
  };
  const std::size_t plane = run(0), line = std::min(run(1), plane);
  const std::size_t count = points.size();
  if (count % plane != 0 || plane % line != 0)
    throw RecordingError(file_name + ": " + std::to_string(count) + " key points in planes of " +
                         std::to_string(plane) + " and lines of " + std::to_string(line) +
                         "; expected a full box");
  box.knots = {static_cast<int>(count / plane), static_cast<int>(plane / line), static_cast<int>(line)};
  for (std::size_t i = 0; i < count; ++i)
    if (const double most = joints[i].cwiseAbs().maxCoeff(); !(most <= kMostAngle))
      throw RecordingError(file_name + ": key point " + std::to_string(i + 1) + " has a joint at " +
                           shown(most) + " rad; expected " + shown(kMostAngle) + " rad at most");
  try {
    IkSeedGrid grid(box, std::move(joints), interpolation);
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3<double> expected = box.knot(
          static_cast<int>(i / plane), static_cast<int>(i % plane / line), static_cast<int>(i % line));
      if ((points[i] - expected).cwiseAbs().maxCoeff() > 1e-9)
        throw std::invalid_argument("key point " + std::to_string(i + 1) +
                                    " is out of line; expected equal steps, z first and x last");
    }
    return grid;
  } catch (const RecordingError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw RecordingError(file_name + ": " + error.what());
  }
}

/// Writes a seed grid; the file appears whole or not at all. Throws RecordingError where it cannot.
inline void save_seed_grid(const std::filesystem::path& path, const IkSeedGrid& grid) {
  FilesToWrite files;
  files.add(path, write_seed_grid(grid));
  files.commit();
}

/// Throws RecordingError as read_seed_grid() does, and where there is no such file.
inline IkSeedGrid load_seed_grid(const std::filesystem::path& path,
                                 GridInterpolation interpolation = GridInterpolation::kCubic) {
  return read_seed_grid(read_file(path), path.string(), interpolation);
}

}  // namespace diabolo
