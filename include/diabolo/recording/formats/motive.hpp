// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <utility>
#include <vector>

#include "diabolo/recording/check.hpp"
#include "diabolo/recording/formats/row_times.hpp"
#include "diabolo/recording/formats/tracked_take.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/csv.hpp"
#include "diabolo/text/error.hpp"
#include "diabolo/text/file.hpp"

namespace diabolo {

/// The first cell of a Motive export, by which it is recognised.
inline constexpr std::string_view kMotiveMark = "Format Version";

/// One pass over a Motive CSV of format 1.22; use read_motive().
class MotiveReader {
 public:
  MotiveReader(std::string_view text, const std::string& file_name)
      : csv_(text, file_name, CutLine::kLeaveOut), times_(csv_) {
    take_.file_name = file_name;
  }

  TrackedTake read() && {
    read_take_line();
    read_columns();
    read_rows();
    return std::move(take_);
  }

 private:
  /// Where the components of one body or marker stand in a row: quaternion x, y, z, w and position x, y, z.
  /// Column 0 is the frame number, so 0 stands for "not there".
  struct Columns {
    std::string_view type, name;
    std::array<std::size_t, 7> at{};
  };

  void read_take_line() {
    const std::vector<std::string_view> cells = csv_.next_cells();
    if (cells.front() != kMotiveMark)
      csv_.fail("starts with " + shown(cells.front()) +
                "; expected \"Format Version\", as Motive exports it");
    const auto value = [&](std::string_view key) -> std::string_view {
      for (std::size_t i = 0; i + 1 < cells.size(); ++i)
        if (cells[i] == key) return cells[i + 1];
      csv_.fail(shown(key) + " is missing; expected it with a value, as Motive exports it");
    };
    const auto expect = [&](std::string_view key, std::string_view expected) {
      if (const std::string_view found = value(key); found != expected)
        csv_.fail(shown(key) + " is " + shown(found) + "; expected " + shown(expected));
    };
    const auto number = [&](std::string_view key) {
      const std::string_view cell = value(key);
      double result = 0.0;
      const std::from_chars_result read = std::from_chars(cell.data(), cell.data() + cell.size(), result);
      if (read.ec != std::errc() || read.ptr != cell.data() + cell.size())
        csv_.fail(shown(key) + " is " + shown(cell) + "; expected a number");
      return result;
    };
    expect("Rotation Type", "Quaternion");
    expect("Coordinate Space", "Global");
    const std::string_view units = value("Length Units");
    if (units == "Centimeters")
      units_per_metre_ = 100.0;
    else if (units == "Millimeters")
      units_per_metre_ = 1000.0;
    else if (units != "Meters")
      csv_.fail("\"Length Units\" is " + shown(units) + "; expected Meters, Centimeters or Millimeters");
    take_.rate = number("Export Frame Rate");
    declared_rows_ = number("Total Exported Frames");
  }

  void read_columns() {
    const auto header_line = [this](const char* expected) {
      if (csv_.at_end()) csv_.fail(std::string("the file ends here; expected ") + expected + " next");
      return csv_.next_cells();
    };
    for (const std::string_view cell : header_line("a blank line"))
      if (!cell.empty()) csv_.fail("starts with " + shown(cell) + "; expected a blank line below the take");
    const std::vector<std::string_view> types = header_line("the line of types (Rigid Body, Marker)");
    const std::vector<std::string_view> names = header_line("the line of names");
    const std::vector<std::string_view> ids = header_line("the line of identifiers");
    const std::vector<std::string_view> kinds = header_line("the line of Rotation and Position");
    const std::vector<std::string_view> axes = header_line("the line \"Frame,Time (Seconds),X,...\"");
    if (axes.size() < 2 || axes[0] != "Frame" || axes[1] != "Time (Seconds)")
      csv_.fail("starts with " + shown(axes[0]) + "; expected \"Frame,Time (Seconds),X,...\"");
    if (types.size() != axes.size() || names.size() != axes.size() || ids.size() != axes.size() ||
        kinds.size() != axes.size())
      csv_.fail(std::to_string(axes.size()) + " columns, but the four lines above have " +
                std::to_string(types.size()) + ", " + std::to_string(names.size()) + ", " +
                std::to_string(ids.size()) + " and " + std::to_string(kinds.size()) + "; expected as many");

    std::unordered_map<std::string_view, std::size_t> bodies, measured, solved;
    for (std::size_t c = 2; c < axes.size(); ++c) {
      const bool is_body = types[c] == "Rigid Body";
      if (!is_body && types[c] != "Marker" && types[c] != "Rigid Body Marker") continue;
      const int axis = axes[c] == "X" ? 0 : axes[c] == "Y" ? 1 : axes[c] == "Z" ? 2 : axes[c] == "W" ? 3 : -1;
      int component = -1;
      if (kinds[c] == "Position" && axis < 3)
        component = axis < 0 ? -1 : 4 + axis;
      else if (kinds[c] == "Rotation" && is_body)
        component = axis;
      else if (kinds[c] != "Position" && kinds[c] != "Rotation")
        continue;  // Error, Marker Quality and the like
      const std::string where = "column " + std::to_string(c + 1);
      if (component < 0)
        csv_.fail(where + ": " + shown(kinds[c]) + " " + shown(axes[c]) + "; expected an axis of it");
      if (names[c].empty()) csv_.fail(where + ": no name in the second line below the blank one");

      std::vector<Columns>& entities = is_body ? body_columns_ : marker_columns_;
      auto& index = is_body ? bodies : types[c] == "Marker" ? measured : solved;
      const auto [entry, is_new] = index.try_emplace(names[c], entities.size());
      if (is_new) entities.push_back({types[c], names[c], {}});
      std::size_t& at = entities[entry->second].at[static_cast<std::size_t>(component)];
      if (at != 0)
        csv_.fail(where + ": " + shown(names[c]) + " has this component in column " + std::to_string(at + 1) +
                  " already; expected every body and marker once");
      at = c;
    }
    check_complete();
    row_.resize(axes.size());
  }

  void check_complete() const {
    static constexpr std::array<const char*, 7> kNames{"Rotation X", "Rotation Y", "Rotation Z", "Rotation W",
                                                       "Position X", "Position Y", "Position Z"};
    const auto check = [this](const Columns& columns, std::size_t first) {
      for (std::size_t k = first; k < columns.at.size(); ++k)
        if (columns.at[k] == 0) csv_.fail(shown(columns.name) + " has no column " + kNames[k]);
    };
    for (const Columns& columns : body_columns_) check(columns, 0);
    for (const Columns& columns : marker_columns_) check(columns, 4);
  }

  void read_rows() {
    csv_.drop_blank_end();
    // A row of C cells has C bytes at least: a file with wrong rows cannot make this large.
    const Eigen::Index size =
        std::min(csv_.lines_left(), static_cast<std::ptrdiff_t>(csv_.bytes_left() / row_.size()) + 1);
    if (csv_.at_end()) csv_.fail("the file ends here; expected at least one line of data");
    take_.frame.reserve(static_cast<std::size_t>(size));
    take_.time.resize(size);
    for (const Columns& columns : body_columns_)
      take_.bodies.push_back(
          {std::string(columns.name), Eigen::Matrix4Xd(4, size), Eigen::Matrix3Xd(3, size), Marks(size)});
    for (const Columns& columns : marker_columns_)
      take_.markers.push_back(
          {std::string(columns.name), columns.type == "Marker", Eigen::Matrix3Xd(3, size), Marks(size)});

    for (Eigen::Index i = 0; !csv_.at_end(); ++i) {
      csv_.next_numbers(row_);
      read_frame_and_time(i);
      for (std::size_t b = 0; b < body_columns_.size(); ++b) read_body(body_columns_[b], take_.bodies[b], i);
      for (std::size_t m = 0; m < marker_columns_.size(); ++m) {
        TrackedMarker& marker = take_.markers[m];
        marker.valid[i] = read_position(marker_columns_[m], marker.position, i);
      }
    }
    const double rows = static_cast<double>(take_.frame.size());
    if (!(rows <= declared_rows_))
      throw RecordingError(take_.file_name + ": " + shown(rows) + " lines of data, but line 1 says " +
                           shown(declared_rows_) + " exported frames; expected no more than it says");
    take_.notes = times_.notes();
    if (rows < declared_rows_)
      take_.notes.push_back("of the " + shown(declared_rows_) + " exported frames that line 1 tells of, " +
                            shown(rows) + " are there: the file is cut off");
    else if (csv_.is_cut())
      take_.notes.push_back(kCutLineNote);
    check_rate(take_.rate, take_.time, take_.file_name);
  }

  void read_frame_and_time(Eigen::Index i) {
    const double frame = row_[0];
    if (!(std::abs(frame) <= 1e15 && std::floor(frame) == frame))
      csv_.fail("frame " + shown(frame) + "; expected a whole number");
    const long number = static_cast<long>(frame);
    if (i > 0 && number <= take_.frame.back())
      csv_.fail("frame " + shown(frame) + " does not come after frame " + std::to_string(take_.frame.back()));
    take_.frame.push_back(number);
    take_.time[i] = times_.next(row_[1]);
  }

  void read_body(const Columns& columns, TrackedBody& body, Eigen::Index i) {
    body.valid[i] = read_position(columns, body.position, i);
    for (std::size_t k = 0; k < 4; ++k) {
      body.quaternion(static_cast<Eigen::Index>(k), i) = row_[columns.at[k]];
      if (std::isnan(row_[columns.at[k]]) == body.valid[i])
        csv_.fail(shown(columns.name) +
                  ": some of its 7 cells are empty; expected none, or all in a dropout");
    }
    if (body.valid[i] && !normalize_quaternion(body.quaternion.col(i)))
      csv_.fail(shown(columns.name) + ": quaternion of norm " + shown(body.quaternion.col(i).norm()) +
                "; expected 1 within 0.001");
  }

  /// False in a dropout.
  bool read_position(const Columns& columns, Eigen::Matrix3Xd& position, Eigen::Index i) {
    int empty = 0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double value = row_[columns.at[static_cast<std::size_t>(4 + k)]] / units_per_metre_;
      position(k, i) = value;
      empty += std::isnan(value);
      if (std::abs(value) > kLargestCoordinate)
        csv_.fail(shown(columns.name) + ": position " + shown(value) +
                  " m; expected within 100 m (other units?)");
    }
    if (empty == 1 || empty == 2)
      csv_.fail(shown(columns.name) + ": " + std::to_string(empty) +
                " of its 3 position cells are empty; expected none, or all in a dropout");
    return empty == 0;
  }

  CsvReader csv_;
  RowTimes times_;
  TrackedTake take_;
  double units_per_metre_ = 1.0;
  double declared_rows_ = 0.0;
  std::vector<Columns> body_columns_, marker_columns_;
  std::vector<double> row_;
};

/// Reads the text of a Motive CSV export, format version 1.22: rigid bodies and markers; other columns
/// (errors, marker qualities) are skipped. Centimetres and millimetres become metres; LF, CRLF and a UTF-8
/// byte order mark are fine. Throws RecordingError with file, line and what was expected: about anything
/// else, and about whatever would make a value doubtful (non-unit quaternions, times that do not increase,
/// other rotations or units). A file that is cut off is read as far as its lines are whole, with a note.
inline TrackedTake read_motive(std::string_view text, const std::string& file_name) {
  return MotiveReader(text, file_name).read();
}

/// Reads a Motive CSV file; see read_motive().
inline TrackedTake load_motive(const std::filesystem::path& path) {
  return read_motive(read_file(path), path.string());
}

}  // namespace diabolo
