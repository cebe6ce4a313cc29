// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "diabolo/recording/check.hpp"
#include "diabolo/text/csv.hpp"

namespace diabolo {

/// Largest stamp of a clock that counts from 1970 [s]: the year 2286.
inline constexpr double kLargestStamp = 1e10;

/// The unit in which a number beyond that is such a stamp, as --columns names it.
inline std::string unit_of_stamp(double stamp) {
  if (stamp <= 1e3 * kLargestStamp) return "ms";
  return stamp <= 1e6 * kLargestStamp ? "us" : "ns";
}

inline constexpr const char* kCutLineNote =
    "the last line has no line end and may be cut off inside a number: it is left out";

/// Checks the times of a file's rows one after another. A first time beyond kLargestTime is a stamp of a
/// clock that counts from 1970; such times are counted from the first row on.
class RowTimes {
 public:
  /// `csv` names file and line, and must outlive this.
  explicit RowTimes(const CsvReader& csv) : csv_(csv) {}

  /// The time of the next row [s], which the file tells in `unit` [s]. Throws RecordingError unless it comes
  /// after the one before, within the same hour and the first row's day.
  double next(double told, double unit = 1.0) {
    const double read = told * unit;
    if (is_first_) start(read, unit_of_stamp(told));
    const double time = read - origin_;
    if (std::isnan(read)) csv_.fail("time is empty; expected a number of seconds");
    if (!(std::abs(time) <= kLargestTime))
      csv_.fail("time " + shown(read) + " s; expected a number within 1e9 s");
    if (!is_first_ && !(time > last_ && time - last_ <= kLongestGap && time - first_ <= kLongestRecording))
      fail(read, time);
    is_first_ = false;
    return last_ = time;
  }

  /// What was changed, a clause each.
  std::vector<std::string> notes() const {
    if (origin_ == 0.0) return {};
    return {"the times are stamps of a clock, from " + shown(origin_) + " s on: they are counted from there"};
  }

 private:
  void start(double read, const std::string& likely_unit) {
    if (read > kLargestStamp)
      csv_.fail("time " + shown(read) + " s; expected seconds (a clock's " + likely_unit +
                ": --columns time=NAME[" + likely_unit + "])");
    if (read > kLargestTime) origin_ = read;
    first_ = read - origin_;
  }

  [[noreturn]] void fail(double read, double time) const {
    const std::string said = "time " + shown(read) + " s ";
    if (time <= last_) csv_.fail(said + "does not come after " + shown(last_ + origin_) + " s");
    if (time - last_ > kLongestGap)
      csv_.fail(said + "comes more than an hour after " + shown(last_ + origin_) +
                " s; expected one take a file");
    csv_.fail(said + "comes more than a day after the first, " + shown(first_ + origin_) +
              " s; expected one take a file");
  }

  const CsvReader& csv_;
  double origin_ = 0.0, first_ = 0.0, last_ = 0.0;
  bool is_first_ = true;
};

}  // namespace diabolo
