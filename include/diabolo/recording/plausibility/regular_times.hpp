// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diabolo/recording/check.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/recording/usual_step.hpp"
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

/// Whether sample i + 1 follows too early or too late to count as the next (Recording::steps_evenly), though
/// no row is left out.
inline bool steps_unevenly(const Recording& r, Eigen::Index i) {
  return i + 1 < r.size() && !r.steps_evenly(i) && (r.time[i + 1] - r.time[i]) * r.rate < kGapInPeriods;
}

/// A step over more periods than this is a gap: where the rows behind it belong is not counted.
inline constexpr double kLongestCounted = 10.0;

/// Whether a step is no whole number of periods, give or take a tenth; of a gap it need not be.
inline bool steps_between_places(double step, double rate) {
  const double periods = step * rate;
  return periods < kLongestCounted && std::abs(periods - std::max(1.0, std::round(periods))) > 0.1;
}

/// Largest share of rows that may step unevenly without a word.
inline constexpr double kMostUneven = 0.02;

/// Share of the rows behind which the step ends between places.
inline double share_between_places(const Eigen::VectorXd& time, double rate) {
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i + 1 < time.size(); ++i)
    count += steps_between_places(time[i + 1] - time[i], rate);
  return static_cast<double>(count) / static_cast<double>(std::max<Eigen::Index>(1, time.size()));
}

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

/// Times of the rows where all step by one period, of least squares, and rows that are left out leave their
/// places free. Between long gaps they keep their mean.
struct EvenTimes {
  double period;         ///< [s]
  Eigen::VectorXd time;  ///< [s]
};

/// Of times that step by about `usual` [s], or multiples.
inline EvenTimes even_times(const Eigen::VectorXd& time, double usual) {
  const Eigen::Index size = time.size();
  Eigen::VectorXd places(size), means(size);  // less the mean of the stretch; the mean time of the stretch
  double covariance = 0.0, variance = 0.0;    // of times and places, within the stretches
  for (Eigen::Index first = 0, end = 0; first < size; first = end) {
    end = first + 1;
    while (end < size && time[end] - time[end - 1] < kLongestCounted * usual) ++end;
    const Eigen::Index rows = end - first;
    const std::vector<double> counted = places_of(time, first, end, usual);
    places.segment(first, rows) = Eigen::Map<const Eigen::VectorXd>(counted.data(), rows);
    places.segment(first, rows).array() -= places.segment(first, rows).mean();
    means.segment(first, rows).setConstant(time.segment(first, rows).mean());
    covariance += places.segment(first, rows).dot(time.segment(first, rows) - means.segment(first, rows));
    variance += places.segment(first, rows).squaredNorm();
  }
  const double period = variance > 0.0 ? covariance / variance : usual;
  return {period, means + period * places};
}

}  // namespace recording_plausibility_detail

/// The rate of times that step evenly but for jitter and gaps [Hz]; there must be two at least. As
/// nearly_whole() has it.
inline double rate_of(const Eigen::VectorXd& time) {
  double period = usual_step(time);
  for (int round = 0; round < 2; ++round)  // the first counts the rows, the second does so by the right step
    period = recording_plausibility_detail::even_times(time, period).period;
  return nearly_whole(1.0 / period);
}

/// Moves jittering stamps to even times: those of a camera that looks evenly and a clock that stamps late.
/// Nothing changes where every step is even, or where too many stamps are too far from their places for the
/// rate to be clear. Returns whether times were moved; a note says by how much, and how many rows may belong
/// beside their places.
inline bool regularise_times(Recording& r) {
  const Eigen::Index size = r.size();
  bool uneven = share_between_places(r.time, r.rate) > kMostUneven;
  for (Eigen::Index i = 0; i < size && !uneven; ++i) uneven = steps_unevenly(r, i);
  if (!uneven) return false;
  const double measured = rate_of(r.time),  // unless the stamps are too far off
      usual = 1.0 / (std::abs(measured / r.rate - 1.0) <= kRateTolerance ? measured : r.rate);
  const auto [period, even] = recording_plausibility_detail::even_times(r.time, usual);
  if (!(std::abs(period * r.rate - 1.0) <= kRateTolerance)) return false;
  const Eigen::VectorXd moved = even - r.time;
  const auto far = (moved.array().abs() > kFarthestStamp * period).count();
  if (static_cast<double>(far) > kMostUneven * static_cast<double>(size)) return false;
  const double jitter = std::sqrt(moved.squaredNorm() / static_cast<double>(size));
  r.notes.push_back("the times jitter by " + shown_rounded(1e3 * jitter) + " ms about " +
                    shown_rounded(1.0 / period) + " Hz: each row is moved to its even time" +
                    (far > 0 ? ", " + std::to_string(far) + " of them by more than " + shown(kFarthestStamp) +
                                   " of a period: they may belong beside it"
                             : ""));
  r.time = even;
  return true;
}

/// By how much a rate may be off that of the times.
inline constexpr double kAnotherRate = 5e-3;

/// The rate by which the times step where another one is stated, see kAnotherRate; nothing where they agree,
/// or are too few to tell.
inline std::optional<double> another_rate(const Recording& r) {
  if (r.size() < 20) return std::nullopt;
  const double measured = rate_of(r.time), off = std::abs(measured / r.rate - 1.0);
  const bool agree = off <= kAnotherRate || off > kRateTolerance;
  if (agree || share_between_places(r.time, measured) > kMostUneven) return std::nullopt;
  return measured;
}

/// The start of a clause about such a rate.
inline std::string rates_in_words(double stated, double measured) {
  return "the rate is given as " + shown_rounded(stated) + " Hz, but the times step at " +
         shown_rounded(measured) + " Hz";
}

/// Puts a stated rate right that the times contradict; a note says so. Frames that were counted by it follow.
inline void put_rate_right(Recording& r) {
  const std::optional<double> measured = another_rate(r);
  if (!measured) return;
  const auto frame_at = [&](Eigen::Index i, double rate) { return std::lround(r.time[i] * rate); };
  bool counted = std::ssize(r.frame) == r.size();
  for (Eigen::Index i = 0; i < r.size() && counted; ++i)
    counted = r.frame[static_cast<std::size_t>(i)] == frame_at(i, r.rate);
  for (Eigen::Index i = 0; i < r.size() && counted; ++i)
    r.frame[static_cast<std::size_t>(i)] = frame_at(i, *measured);
  r.notes.push_back(rates_in_words(r.rate, *measured) + ", which counts");
  r.rate = *measured;
}

/// A clause about times that step unevenly, whether they can be put right or no rate is clear, or too slowly
/// for play; else empty.
inline std::string odd_times(const Recording& r) {
  constexpr double kLongestPeriod = 0.2;  // s; a beat of the hands has two samples at least
  if (r.size() < 20) return {};
  if (r.rate * kLongestPeriod < 1.0)
    return "the rows are " + shown_rounded(1.0 / r.rate) +
           " s apart, too far for play: the times may be in other units";
  if (const std::optional<double> measured = another_rate(r)) return rates_in_words(r.rate, *measured);
  const double share = share_between_places(r.time, r.rate);
  if (share <= kMostUneven) return {};
  const std::string rows = " in " + std::to_string(std::lround(100.0 * share)) + " % of the rows";
  if (Recording even = r; regularise_times(even))
    return "the times jitter about a steady " + shown_rounded(rate_of(even.time)) + " Hz" + rows +
           ", where no velocities are known: put_right() moves each row to its even time";
  return "the times step unevenly" + rows + ", too far from a steady " + shown_rounded(r.rate) +
         " Hz to be put right: no velocities are known there";
}

}  // namespace diabolo
