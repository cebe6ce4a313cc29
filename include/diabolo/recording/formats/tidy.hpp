// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "diabolo/recording/check.hpp"
#include "diabolo/recording/formats/columns.hpp"
#include "diabolo/recording/formats/row_times.hpp"
#include "diabolo/recording/plausibility/regular_times.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/csv.hpp"
#include "diabolo/text/error.hpp"

namespace diabolo {

/// What a tidy CSV leaves to the JSON file beside it.
struct TidyMetadata {
  DiaboloProperties properties = kRedDiabolo;
  double string_length = kPublishedStringLength;  ///< [m]
  double rate = 0.0;                              ///< nominal sampling rate [Hz]; 0: that of the times
  std::vector<std::string> assumed = {};          ///< those of kAssumable that it does not tell
  double clock = 0.0;                             ///< of laws in time, at the first row [s]
};

/// One pass over a tidy CSV; use read_tidy().
class TidyReader {
 public:
  TidyReader(std::string_view text, const std::string& file_name, const std::vector<MappedColumn>& columns)
      : csv_(text, file_name, CutLine::kLeaveOut), times_(csv_), columns_(columns) {}

  Recording read(const TidyMetadata& metadata) && {
    read_header();
    csv_.drop_blank_end();
    if (csv_.at_end()) csv_.fail("the file ends here; expected at least one line of data");
    // A row of C cells has C bytes at least: a file with wrong rows cannot make this large.
    const Eigen::Index size =
        std::min(csv_.lines_left(), static_cast<std::ptrdiff_t>(csv_.bytes_left() / row_.size()) + 1);
    Recording result;
    result.file = csv_.file();
    result.name = std::filesystem::path(result.file).stem().string();
    result.rate = metadata.rate;
    result.properties = metadata.properties;
    result.string_length = metadata.string_length;
    result.assumed = metadata.assumed;
    result.clock = metadata.clock;
    result.time.resize(size);
    result.left = result.right = result.diabolo = Track::missing(size);
    result.diabolo_orientation = OrientationTrack::missing(size);
    if (has(kLeftOrientation)) result.left_orientation = OrientationTrack::missing(size);
    if (has(kRightOrientation)) result.right_orientation = OrientationTrack::missing(size);
    for (Eigen::Index i = 0; !csv_.at_end(); ++i) {
      csv_.next_numbers(row_, ignored_);
      result.time[i] = times_.next(row_[at_[0]], unit_[0]);
      read_position(result.left, 1, i);
      read_position(result.right, 4, i);
      read_position(result.diabolo, kDiabolo, i);
      if (has(kDiaboloOrientation)) read_orientation(result.diabolo_orientation, kDiaboloOrientation, i);
      if (has(kLeftOrientation)) read_orientation(result.left_orientation, kLeftOrientation, i);
      if (has(kRightOrientation)) read_orientation(result.right_orientation, kRightOrientation, i);
    }
    if (result.rate == 0.0 && size > 1) result.rate = rate_of(result.time);
    check_rate(result.rate, result.time, csv_.file());
    check_properties(result.properties, result.string_length, csv_.file());
    for (const double time : result.time) result.frame.push_back(std::lround(time * result.rate));
    result.notes = times_.notes();
    if (csv_.is_cut()) result.notes.push_back(kCutLineNote);
    return result;
  }

 private:
  static constexpr std::size_t kDiabolo = 7, kDiaboloOrientation = 10, kLeftOrientation = 14,
                               kRightOrientation = 18;
  static constexpr std::size_t kAbsent = kTidyColumns.size();

  bool has(std::size_t column) const { return at_[column] != kAbsent; }

  void read_header() {
    const std::vector<std::string_view> cells = csv_.next_cells();
    csv_.name_columns(cells);
    at_.fill(kAbsent);
    unit_.fill(1.0);
    row_.resize(cells.size());
    if (columns_.empty()) {
      for (std::size_t c = 0; c < cells.size(); ++c) {
        const auto column = std::ranges::find(kTidyColumns, cells[c]);
        if (column == kTidyColumns.end())
          csv_.fail("column " + std::to_string(c + 1) + " is " + shown(cells[c]) +
                    ", which a tidy recording lacks (--columns maps other names)");
        place(column - kTidyColumns.begin(), c);
      }
    } else {
      map_columns(cells);
    }
    for (std::size_t k = 0; k < kTidyColumns.size(); ++k) {
      const std::size_t first = k < kDiaboloOrientation ? k : k - (k - kDiaboloOrientation) % 4;
      const bool is_needed =
          k < kDiaboloOrientation || has(first) || has(first + 1) || has(first + 2) || has(first + 3);
      if (is_needed && !has(k))
        csv_.fail("column " + shown(kTidyColumns[k]) + " is missing" +
                  (k == kDiabolo && !has(k + 1) && !has(k + 2)
                       ? ": these are the sticks alone; expected a recording of the diabolo, too"
                       : ""));
    }
  }

  void place(std::ptrdiff_t tidy, std::size_t cell) {
    std::size_t& at = at_[static_cast<std::size_t>(tidy)];
    if (at != kAbsent)
      csv_.fail("column " + shown(kTidyColumns[static_cast<std::size_t>(tidy)]) + " is there twice");
    at = cell;
  }

  /// One column may stand for several numbers of an orientation, such as zeros, but for one of a position.
  void check_mapped_once() const {
    const auto turns = [](const MappedColumn& column) { return column.tidy.find("_q") != std::string::npos; };
    for (auto one = columns_.begin(); one != columns_.end(); ++one)
      for (auto other = columns_.begin(); other != one; ++other) {
        if (one->tidy == other->tidy)
          csv_.fail("columns: " + one->tidy + " is mapped to " + shown(other->given) + " and to " +
                    shown(one->given) + "; expected one of them");
        if (one->bare == other->bare && !(turns(*one) && turns(*other)))
          csv_.fail("columns: " + shown(one->bare) + " is mapped to " + other->tidy + " and to " + one->tidy +
                    "; expected a column for each");
      }
  }

  /// Finds the columns that are mapped, then tidy ones that are not, and lets the others be.
  void map_columns(const std::vector<std::string_view>& cells) {
    check_mapped_once();
    for (const MappedColumn& column : columns_) {
      const std::ptrdiff_t tidy = std::ranges::find(kTidyColumns, column.tidy) - kTidyColumns.begin();
      bool found = false;
      for (const std::string& name : {column.given, column.bare})
        for (std::size_t c = 0; c < cells.size() && !found; ++c)
          if (cells[c] == name) place(tidy, c), found = true;
      if (!found) {
        std::string names;
        for (std::size_t c = 0; c < std::min<std::size_t>(cells.size(), 30); ++c)
          names += (c > 0 ? ", " : "") + shown(cells[c]);
        csv_.fail("no column " + shown(column.bare) + " for " + column.tidy + "; the file has " + names);
      }
      unit_[static_cast<std::size_t>(tidy)] = column.unit;
    }
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto column = std::ranges::find(kTidyColumns, cells[c]);
      if (column != kTidyColumns.end() && !has(static_cast<std::size_t>(column - kTidyColumns.begin())) &&
          std::ranges::find(at_, c) == at_.end())
        place(column - kTidyColumns.begin(), c);
    }
    ignored_.assign(cells.size(), 1);
    for (const std::size_t at : at_)
      if (at != kAbsent) ignored_[at] = 0;
  }

  double value(std::size_t column) const { return row_[at_[column]] * unit_[column]; }

  /// Whether the `count` cells from a column on are empty; RecordingError where only some are.
  bool all_empty(std::size_t column, std::size_t count) const {
    std::size_t empty = 0;
    for (std::size_t k = 0; k < count; ++k) empty += std::isnan(value(column + k));
    if (empty != 0 && empty != count)
      csv_.fail(std::to_string(empty) + " of " + std::to_string(count) + " cells from " +
                shown(kTidyColumns[column]) + " on are empty; expected none, or all in a dropout");
    return empty != 0;
  }

  void read_position(Track& track, std::size_t column, Eigen::Index i) const {
    if (all_empty(column, 3)) return;
    track.valid[i] = true;
    track.position.col(i) << value(column), value(column + 1), value(column + 2);
    if (track.position.col(i).cwiseAbs().maxCoeff() > kLargestCoordinate)
      csv_.fail(shown(kTidyColumns[column]) +
                " and on: " + shown(track.position.col(i).cwiseAbs().maxCoeff()) +
                " m; expected positions within 100 m (other units?)");
  }

  void read_orientation(OrientationTrack& track, std::size_t column, Eigen::Index i) const {
    if (all_empty(column, 4)) return;
    track.valid[i] = true;
    track.quaternion.col(i) << value(column), value(column + 1), value(column + 2), value(column + 3);
    if (!normalize_quaternion(track.quaternion.col(i)))
      csv_.fail(shown(kTidyColumns[column]) + " and on: quaternion of norm " +
                shown(track.quaternion.col(i).norm()) + "; expected 1 within 0.001");
  }

  CsvReader csv_;
  RowTimes times_;
  const std::vector<MappedColumn>& columns_;  ///< of a CSV of somebody's own; none of a tidy one
  std::array<std::size_t, kTidyColumns.size()> at_{};
  std::array<double, kTidyColumns.size()> unit_{};
  std::vector<char> ignored_;
  std::vector<double> row_;
};

/// Reads the text of a tidy CSV: kTidyColumns in any order, empty cells for dropouts. `frame` is time * rate,
/// rounded; the recording is named after the file. `columns` map a CSV of somebody's own, of which other
/// columns are left alone and the diabolo's orientation may be missing. Throws RecordingError with file, line
/// and what was expected.
inline Recording read_tidy(std::string_view text, const std::string& file_name, const TidyMetadata& metadata,
                           const std::vector<MappedColumn>& columns = {}) {
  return TidyReader(text, file_name, columns).read(metadata);
}

/// The text of a tidy CSV, numbers in their shortest form that reads back as the same double.
/// Throws RecordingError where `recording` is not what its type promises.
inline std::string write_tidy(const Recording& recording) {
  check_recording(recording);
  if (recording.size() == 0) throw RecordingError(recording.title() + ": no samples to write");
  const bool left = !recording.left_orientation.empty(), right = !recording.right_orientation.empty();
  std::string text;
  for (std::size_t k = 0; k < kTidyColumns.size(); ++k)
    if (k < 14 || (k < 18 ? left : right)) text.append(k == 0 ? "" : ",").append(kTidyColumns[k]);
  text += '\n';
  const auto put = [&text](const auto& track, const auto& values, Eigen::Index i) {
    const bool valid = i < track.valid.size() && track.valid[i];
    for (Eigen::Index k = 0; k < values.rows(); ++k) {
      text += ',';
      if (valid) text += shown(values(k, i));
    }
  };
  for (Eigen::Index i = 0; i < recording.size(); ++i) {
    text += shown(recording.time[i]);
    put(recording.left, recording.left.position, i);
    put(recording.right, recording.right.position, i);
    put(recording.diabolo, recording.diabolo.position, i);
    put(recording.diabolo_orientation, recording.diabolo_orientation.quaternion, i);
    if (left) put(recording.left_orientation, recording.left_orientation.quaternion, i);
    if (right) put(recording.right_orientation, recording.right_orientation.quaternion, i);
    text += '\n';
  }
  return text;
}

}  // namespace diabolo
