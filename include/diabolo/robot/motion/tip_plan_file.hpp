// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/recording/formats/tidy.hpp"
#include "diabolo/robot/motion/tip_ticks.hpp"
#include "diabolo/sticks.hpp"
#include "diabolo/text/file.hpp"

namespace diabolo {

/// Reads the tips of a plan: a CSV with the columns time, left_x, left_y, left_z, right_x, right_y and
/// right_z [s, m, world] in any order; the other columns of a tidy recording may be there and count for
/// nothing. In between, the tips follow a natural cubic spline. Throws RecordingError with file, line and
/// what was expected; a plan has no dropouts.
inline TipMotion<double> read_tip_plan(std::string_view text, const std::string& file_name) {
  constexpr std::size_t kColumns = 7;  // the first of kTidyColumns
  CsvReader csv(text, file_name);
  const std::vector<std::string_view> header = csv.next_cells();
  std::array<std::size_t, kColumns> at{};
  for (const std::string_view cell : header)
    if (std::ranges::find(kTidyColumns, cell) == kTidyColumns.end())
      csv.fail("column " + shown(cell) + ", which neither a plan nor a tidy recording has");
  for (std::size_t k = 0; k < kColumns; ++k) {
    if (std::ranges::count(header, kTidyColumns[k]) != 1)
      csv.fail("column " + shown(kTidyColumns[k]) + " is there " +
               std::to_string(std::ranges::count(header, kTidyColumns[k])) + " times; expected once");
    at[k] = static_cast<std::size_t>(std::ranges::find(header, kTidyColumns[k]) - header.begin());
  }
  csv.drop_blank_end();
  std::vector<double> row(header.size()), times;
  std::vector<Vector3<double>> left, right;
  while (!csv.at_end()) {
    csv.next_numbers(row);
    for (std::size_t k = 0; k < kColumns; ++k) {
      const double limit = k == 0 ? kLargestTime : kLargestCoordinate;
      if (std::isnan(row[at[k]])) csv.fail(shown(kTidyColumns[k]) + " is empty; expected a number");
      if (std::abs(row[at[k]]) > limit)
        csv.fail(shown(kTidyColumns[k]) + ": " + shown(row[at[k]]) + "; expected a number within " +
                 shown(limit));
    }
    if (!times.empty() && row[at[0]] <= times.back())
      csv.fail("time " + shown(row[at[0]]) + " s does not come after " + shown(times.back()) + " s");
    times.push_back(row[at[0]]);
    left.emplace_back(row[at[1]], row[at[2]], row[at[3]]);
    right.emplace_back(row[at[4]], row[at[5]], row[at[6]]);
  }
  if (times.size() < 2)
    throw RecordingError(file_name + ": " + std::to_string(times.size()) +
                         " lines of data; a plan has two or more");
  if (times.back() - times.front() > kLongestMotion)
    throw RecordingError(file_name + ": lasts " + shown(times.back() - times.front()) + " s; expected " +
                         shown(kLongestMotion) + " s at most");
  return TipMotion<double>(std::move(times), left, right, Interpolation::kSpline);
}

/// Throws RecordingError as read_tip_plan() does, and where there is no such file.
inline TipMotion<double> load_tip_plan(const std::filesystem::path& path) {
  return read_tip_plan(read_file(path), path.string());
}

}  // namespace diabolo
