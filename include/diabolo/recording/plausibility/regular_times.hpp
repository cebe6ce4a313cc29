// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "diabolo/recording/check.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A step longer than this many periods leaves out rows; a stamp farther than this many periods from its
/// place may belong to the row beside.
inline constexpr double kGapInPeriods = 1.5, kFarthestStamp = 0.4;

/// A rate [Hz], whole where it is within half a thousandth of a whole number.
inline double nearly_whole(double rate) {
  const double whole = std::round(rate);
  return whole > 0.0 && std::abs(rate - whole) < 5e-4 * whole ? whole : rate;
}

/// The step that leaves out no row [s]: the median, or a half or a third of it where a quarter of the steps
/// are near that.
inline double shortest_usual_step(const Eigen::VectorXd& time) {
  const double median = median_step(time);
  for (const double parts : {3.0, 2.0}) {
    const double step = median / parts;
    Eigen::Index near = 0;
    for (Eigen::Index i = 0; i + 1 < time.size(); ++i)
      near += std::abs(time[i + 1] - time[i] - step) < 0.25 * step;
    if (4 * near >= time.size() - 1) return step;
  }
  return median;
}

/// The rate of times that step evenly but for jitter and gaps [Hz]; there must be two at least. As
/// nearly_whole() has it.
inline double rate_of(const Eigen::VectorXd& time) {
  const double usual = shortest_usual_step(time);
  double sum = 0.0;
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i + 1 < time.size(); ++i) {
    const double step = time[i + 1] - time[i];
    if (std::abs(step - usual) < 0.5 * usual) sum += step, ++count;
  }
  return nearly_whole(static_cast<double>(count) / sum);
}

/// Whether sample i + 1 follows too early or too late to count as the next (Recording::steps_evenly), though
/// no row is left out.
inline bool steps_unevenly(const Recording& r, Eigen::Index i) {
  return i + 1 < r.size() && !r.steps_evenly(i) && (r.time[i + 1] - r.time[i]) * r.rate < kGapInPeriods;
}

/// Largest share of rows that may step unevenly without a word.
inline constexpr double kMostUneven = 0.02;

/// A step over more periods than this is a gap: where the rows behind it belong is not counted.
inline constexpr double kLongestCounted = 10.0;

namespace recording_plausibility_detail {

/// Places of the rows [first, end) on a grid of that period [s], from 0 on. Rows may be left out; the grid
/// follows the stamps slowly. Of two that come to lie on one place, the first was late where a place before
/// it is free, and so were the rows between, as after a stall; else the second is early.
inline std::vector<double> places_of(const Eigen::VectorXd& time, Eigen::Index first, Eigen::Index end,
                                     double period) {
  constexpr double kFollows = 0.1;
  constexpr std::size_t kLongestRun = 10;
  std::vector<double> places{0.0};
  double last = time[first];
  for (Eigen::Index i = first + 1; i < end; ++i) {
    double steps = std::round((time[i] - last) / period);
    if (steps < 1.0) {
      std::size_t late = places.size() - 1;  // the first of those that were
      while (late > 0 && places.size() - late < kLongestRun && places[late] - places[late - 1] <= 1.0) --late;
      if (late > 0 && places[late] - places[late - 1] > 1.0) {
        for (std::size_t k = late; k < places.size(); ++k) places[k] -= 1.0;
        last -= period;
      }
      steps = 1.0;
    }
    places.push_back(places.back() + steps);
    last += steps * period;
    last += kFollows * (time[i] - last);
  }
  return places;
}

}  // namespace recording_plausibility_detail

/// Moves jittering stamps to even times: those of a camera that looks evenly and a clock that stamps late.
/// Between long gaps the times keep their mean; all have the same period, that of least squares, and rows
/// that are left out leave their place free. Nothing changes where every step is even, or where too many
/// stamps are too far from their places for the rate to be clear. A rate that is
/// off by more than half a percent is put right. Returns whether times were moved; a note
/// says by how much.
inline bool regularise_times(Recording& r) {
  const Eigen::Index size = r.size();
  bool uneven = false;
  for (Eigen::Index i = 0; i < size && !uneven; ++i) uneven = steps_unevenly(r, i);
  if (!uneven) return false;
  const double measured = rate_of(r.time),  // unless most rows are left out
      usual = 1.0 / (std::abs(measured / r.rate - 1.0) <= 0.05 ? measured : r.rate);
  Eigen::VectorXd places(size), means(size);  // less the mean of the stretch; the mean time of the stretch
  double covariance = 0.0, variance = 0.0;    // of times and places, within the stretches
  for (Eigen::Index first = 0, end = 0; first < size; first = end) {
    end = first + 1;
    while (end < size && r.time[end] - r.time[end - 1] < kLongestCounted * usual) ++end;
    const Eigen::Index rows = end - first;
    const std::vector<double> counted = recording_plausibility_detail::places_of(r.time, first, end, usual);
    places.segment(first, rows) = Eigen::Map<const Eigen::VectorXd>(counted.data(), rows);
    places.segment(first, rows).array() -= places.segment(first, rows).mean();
    means.segment(first, rows).setConstant(r.time.segment(first, rows).mean());
    covariance += places.segment(first, rows).dot(r.time.segment(first, rows) - means.segment(first, rows));
    variance += places.segment(first, rows).squaredNorm();
  }
  const double period = covariance / variance;
  if (!(std::abs(period * r.rate - 1.0) <= 0.05)) return false;  // as check_rate() has it
  const Eigen::VectorXd even = means + period * places, moved = even - r.time;
  const auto far = (moved.array().abs() > kFarthestStamp * period).count();
  if (static_cast<double>(far) > kMostUneven * static_cast<double>(size)) return false;
  const double jitter = std::sqrt(moved.squaredNorm() / static_cast<double>(size));
  r.notes.push_back("the times jitter by " + shown_rounded(1e3 * jitter) + " ms about " +
                    shown_rounded(1.0 / period) + " Hz: each row is moved to its even time");
  r.time = even;
  if (constexpr double kAnotherRate = 5e-3; std::abs(period * r.rate - 1.0) > kAnotherRate)
    r.rate = nearly_whole(1.0 / period);
  return true;
}

/// A clause about times that step unevenly where no rate is clear, or too slowly for play; else empty.
inline std::string odd_times(const Recording& r) {
  constexpr double kLongestPeriod = 0.2;  // s; a beat of the hands has two samples at least
  if (r.size() < 20) return {};
  if (r.rate * kLongestPeriod < 1.0)
    return "the rows are " + shown_rounded(1.0 / r.rate) +
           " s apart, too far for play: the times may be in other units";
  Eigen::Index uneven = 0;
  for (Eigen::Index i = 0; i < r.size(); ++i) uneven += steps_unevenly(r, i);
  const double share = static_cast<double>(uneven) / static_cast<double>(r.size());
  if (share <= kMostUneven) return {};
  return "the times step unevenly in " + std::to_string(std::lround(100.0 * share)) +
         " % of the rows, too far from a steady " + shown(r.rate) +
         " Hz to be put right: no velocities are known there";
}

}  // namespace diabolo
