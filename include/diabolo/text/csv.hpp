// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "diabolo/text/error.hpp"
#include "diabolo/text/shown.hpp"
#include "diabolo/text/utf8.hpp"

namespace diabolo {

/// `text` without a UTF-8 byte order mark. Throws RecordingError where it is empty or is not UTF-8 without
/// zero bytes.
inline std::string_view utf8_text(std::string_view text, const std::string& file) {
  if (text.empty()) throw RecordingError(file + ": the file is empty");
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw RecordingError(file + ": the text is UTF-16; expected UTF-8");
  if (text.starts_with("\x1f\x8b"))
    throw RecordingError(file + ": the file is compressed by gzip; expected it unpacked");
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  const auto fail_at = [&](std::size_t at, const std::string& what) {
    const std::ptrdiff_t line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw RecordingError(file + ", line " + std::to_string(line) + ": " + what + "; expected text in UTF-8");
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text.substr(at));
    if (length == 0) fail_at(at, "the byte " + shown(text.substr(at, 1)) + " belongs to another encoding");
    if (text[at] == '\0') fail_at(at, "a zero byte (UTF-16 or not a text)");
    at += length;
  }
  return text;
}

/// What becomes of a last line without a line end, which may be cut off inside a number.
enum class CutLine { kRefuse, kLeaveOut };

/// Reads CSV text line by line and keeps count, so that every complaint can name file and line.
/// Lines end with LF or CRLF, the last one too.
class CsvReader {
 public:
  /// `text` must outlive the reader. Throws RecordingError as utf8_text() does, and on line ends of another
  /// kind.
  CsvReader(std::string_view text, std::string file, CutLine cut_line = CutLine::kRefuse)
      : file_(std::move(file)) {
    text = utf8_text(text, file_);
    if (text.find('\n') == text.npos && text.find('\r') != text.npos)
      throw RecordingError(file_ + ": lines end with CR only (old Mac); expected LF or CRLF");
    const std::size_t whole = text.rfind('\n') + 1;  // 0 where there is no line end
    is_cut_ = whole < text.size();
    if (is_cut_ && (cut_line == CutLine::kRefuse || whole == 0))
      throw RecordingError(file_ + ": the last line has no line end; the file may be cut off");
    text = text.substr(0, whole);
    at_ = text.data();
    end_ = text.data() + text.size();
  }

  const std::string& file() const { return file_; }
  bool at_end() const { return at_ == end_; }
  /// Whether a last line without a line end was left out.
  bool is_cut() const { return is_cut_; }
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }

  /// Number of lines that are left.
  std::ptrdiff_t lines_left() const { return std::count(at_, end_, '\n'); }

  /// Lets blank lines at the end of the text count as nothing.
  void drop_blank_end() {
    std::string_view left(at_, bytes_left());
    while (left.ends_with("\n\n") || left.ends_with("\n\r\n") || left == "\n" || left == "\r\n")
      left.remove_suffix(left.ends_with("\r\n") ? 2 : 1);
    end_ = at_ + left.size();
  }

  /// Throws RecordingError about the line read last.
  [[noreturn]] void fail(const std::string& what) const {
    throw RecordingError(file_ + ", line " + std::to_string(line_) + ": " + what);
  }

  /// The next line without its end; there must be one (see at_end()).
  std::string_view next_line() {
    ++line_;
    const char* stop = std::find(at_, end_, '\n');
    std::string_view line(at_, static_cast<std::size_t>(stop - at_));
    at_ = stop + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find('\r') != line.npos) fail("a CR inside the line; expected LF or CRLF as line end");
    return line;
  }

  /// Lets complaints about numbers name their columns.
  void name_columns(const std::vector<std::string_view>& names) { names_.assign(names.begin(), names.end()); }

  /// The cells of the next line; quotes around a cell are taken off.
  std::vector<std::string_view> next_cells() {
    std::string_view rest = next_line();
    std::vector<std::string_view> cells;
    for (;;) {
      const bool in_quotes = rest.starts_with('"');
      if (in_quotes) rest.remove_prefix(1);
      const std::size_t stop = std::min(rest.find(in_quotes ? '"' : ','), rest.size());
      if (in_quotes && stop == rest.size()) fail("a quote is not closed");
      cells.push_back(rest.substr(0, stop));
      rest.remove_prefix(in_quotes ? stop + 1 : stop);
      if (rest.empty()) return cells;
      if (rest.front() != ',')
        fail("text follows the quoted cell " + shown(cells.back()) + "; expected a comma");
      rest.remove_prefix(1);
    }
  }

  /// Fills `row` from the next line, which must have as many cells: finite numbers, or NaN where a cell is
  /// empty. Of cells that are `ignored` (none where that is empty) nothing is read.
  void next_numbers(std::vector<double>& row, const std::vector<char>& ignored = {}) {
    ++line_;
    const char* const start = at_;
    const char* at = start;  // The text ends with LF and no step passes one, so *at is always there.
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0 && *at++ != ',') fail_ragged(start, row.size());
      if (!ignored.empty() && ignored[i] != 0) at = std::find_if(at, end_, ends_cell);
      if (ends_cell(*at)) {
        row[i] = std::numeric_limits<double>::quiet_NaN();
        continue;
      }
      const std::from_chars_result result = std::from_chars(at, end_, row[i]);
      if (result.ec == std::errc() && ends_cell(*result.ptr) && std::isfinite(row[i]))
        at = result.ptr;
      else
        row[i] = padded_number(at, i + 1);
    }
    if (*at == '\r') ++at;
    if (*at != '\n') fail_ragged(start, row.size());
    at_ = at + 1;
  }

 private:
  static bool ends_cell(char c) { return c == ',' || c == '\n' || c == '\r'; }

  [[noreturn]] void fail_ragged(const char* start, std::size_t expected) const {
    const char* const stop = std::find(start, end_, '\n');
    const char* const cr = std::find(start, stop, '\r');
    if (cr != stop && cr + 1 != stop) fail("a CR inside the line; expected LF or CRLF as line end");
    if (cr == start || stop == start) fail("an empty line; expected a row of the table");
    const std::ptrdiff_t found = 1 + std::count(start, stop, ',');
    fail(std::to_string(found) + " cells; expected " + std::to_string(expected) + ", as in the header");
  }

  /// A number with blanks around it (NaN where there are only blanks); moves `at` to the end of the cell.
  double padded_number(const char*& at, std::size_t column) const {
    const char* const stop = std::find_if(at, end_, ends_cell);
    const std::string_view cell(at, static_cast<std::size_t>(stop - at));
    at = stop;
    const std::size_t first = cell.find_first_not_of(" \t");
    if (first == cell.npos) return std::numeric_limits<double>::quiet_NaN();
    const std::string_view digits = cell.substr(first, cell.find_last_not_of(" \t") + 1 - first);
    double value = 0.0;
    const std::from_chars_result result =
        std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (result.ec != std::errc() || result.ptr != digits.data() + digits.size() || !std::isfinite(value))
      fail("column " + (names_.empty() ? std::to_string(column) : shown(names_[column - 1])) + ": " +
           shown(cell) + "; expected a finite number or an empty cell");
    return value;
  }

  std::string file_;
  const char* at_ = nullptr;
  const char* end_ = nullptr;
  long line_ = 0;
  bool is_cut_ = false;
  std::vector<std::string> names_;
};

}  // namespace diabolo
