// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/text/error.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// The columns of a tidy CSV: s, m, unit quaternions; world frame, body x = spin axis or along the stick
/// outwards. The last eight, the orientation of the sticks, may be left out, each stick's four together.
inline constexpr std::array<std::string_view, 22> kTidyColumns{
    "time",      "left_x",    "left_y",     "left_z",     "right_x",    "right_y",    "right_z", "diabolo_x",
    "diabolo_y", "diabolo_z", "diabolo_qx", "diabolo_qy", "diabolo_qz", "diabolo_qw", "left_qx", "left_qy",
    "left_qz",   "left_qw",   "right_qx",   "right_qy",   "right_qz",   "right_qw"};

/// Where a tidy column is found in a CSV of somebody's own.
struct MappedColumn {
  std::string tidy;   ///< of kTidyColumns
  std::string given;  ///< the name in the file's header: as written here, or without its unit
  std::string bare;   ///< the name without its unit
  double unit = 1.0;  ///< of its numbers [s or m]
};

/// Units that a column may be in: what is measured, the name and its size in s or m.
struct ColumnUnit {
  bool is_time;
  std::string_view name;
  double size;
};
inline constexpr std::array<ColumnUnit, 9> kColumnUnits{{{true, "s", 1.0},
                                                         {true, "ms", 1e-3},
                                                         {true, "us", 1e-6},
                                                         {true, "ns", 1e-9},
                                                         {false, "m", 1.0},
                                                         {false, "cm", 1e-2},
                                                         {false, "mm", 1e-3},
                                                         {false, "in", 0.0254},
                                                         {false, "ft", 0.3048}}};

/// The column that `text` names, "NAME" or "NAME[UNIT]", for a tidy one. Throws RecordingError about another
/// tidy name and another unit.
inline MappedColumn column_of(std::string_view tidy, std::string_view text) {
  const std::string where = "columns: " + std::string(tidy) + "=" + std::string(text);
  const auto at = std::find(kTidyColumns.begin(), kTidyColumns.end(), tidy);
  if (at == kTidyColumns.end())
    throw RecordingError("columns: " + shown(tidy) + "; expected time, left_x, diabolo_qw and the like");
  MappedColumn column{std::string(tidy), std::string(text), std::string(text), 1.0};
  if (text.empty()) throw RecordingError(where + "; expected the name of a column");
  const std::size_t open = text.rfind('[');
  if (open == text.npos || open == 0 || !text.ends_with(']')) return column;
  const std::string_view unit = text.substr(open + 1, text.size() - open - 2);
  const bool is_time = tidy == "time", is_length = tidy.find("_q") == tidy.npos && !is_time;
  for (const ColumnUnit& known : kColumnUnits)
    if (known.name == unit && (known.is_time ? is_time : is_length)) {
      column.bare = text.substr(0, open);
      column.unit = known.size;
      return column;
    }
  throw RecordingError(where + ": unit " + shown(unit) + "; expected " +
                       (is_time     ? "s, ms, us or ns"
                        : is_length ? "m, cm, mm, in or ft"
                                    : "none, of a quaternion"));
}

/// Reads "time=t[ms],left_x=lx[mm],...". Throws RecordingError about another text.
inline std::vector<MappedColumn> columns_of(std::string_view text) {
  std::vector<MappedColumn> columns;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t stop = std::min(text.find(',', first), text.size());
    const std::string_view part = text.substr(first, stop - first);
    const std::size_t equals = part.find('=');
    if (equals == part.npos)
      throw RecordingError("columns: " + shown(part) + "; expected TIDY=NAME[UNIT], such as left_x=lx[mm]");
    columns.push_back(column_of(part.substr(0, equals), part.substr(equals + 1)));
    first = stop + 1;
  }
  return columns;
}

}  // namespace diabolo
