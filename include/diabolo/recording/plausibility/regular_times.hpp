// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>

#include "diabolo/recording/check.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A step longer than this many periods leaves out rows; a stamp farther than this many periods from its
/// place may belong to the row beside.
inline constexpr double kGapInPeriods = 1.5, kFarthestStamp = 0.4;

/// The rate of times that step evenly but for jitter and gaps [Hz]; there must be two at least. Whole where
/// it is within half a thousandth of a whole number.
inline double rate_of(const Eigen::VectorXd& time) {
  const double usual = median_step(time);
  double sum = 0.0;
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i + 1 < time.size(); ++i) {
    const double step = time[i + 1] - time[i];
    if (std::abs(step - usual) < 0.5 * usual) sum += step, ++count;
  }
  const double rate = static_cast<double>(count) / sum, whole = std::round(rate);
  return whole > 0.0 && std::abs(rate - whole) < 5e-4 * whole ? whole : rate;
}

/// Whether sample i + 1 follows too early or too late to count as the next (Recording::steps_evenly), though
/// no row is left out.
inline bool steps_unevenly(const Recording& r, Eigen::Index i) {
  return i + 1 < r.size() && !r.steps_evenly(i) && (r.time[i + 1] - r.time[i]) * r.rate < kGapInPeriods;
}

/// Moves jittering stamps to even times: those of a camera that looks evenly and a clock that stamps late.
/// Each stretch without gaps keeps its mean time; all have the same period, that of least squares. Nothing
/// changes where every step is even, or where a stamp is too far from its place for the rate to be clear.
/// Returns whether times were moved; a note says by how much.
inline bool regularise_times(Recording& r) {
  const Eigen::Index size = r.size();
  bool uneven = false;
  for (Eigen::Index i = 0; i < size && !uneven; ++i) uneven = steps_unevenly(r, i);
  if (!uneven) return false;
  const auto stretch_end = [&r, size](Eigen::Index first) {
    Eigen::Index end = first + 1;
    while (end < size && (r.time[end] - r.time[end - 1]) * r.rate < kGapInPeriods) ++end;
    return end;
  };
  const auto middle = [](Eigen::Index first, Eigen::Index end) {
    return 0.5 * static_cast<double>(first + end - 1);
  };
  double covariance = 0.0, variance = 0.0;  // of times and row numbers, within the stretches
  for (Eigen::Index first = 0, end = 0; first < size; first = end) {
    end = stretch_end(first);
    const double mean = r.time.segment(first, end - first).mean();
    for (Eigen::Index i = first; i < end; ++i) {
      const double number = static_cast<double>(i) - middle(first, end);
      covariance += number * (r.time[i] - mean);
      variance += number * number;
    }
  }
  const double period = covariance / variance;
  if (!(std::abs(period * r.rate - 1.0) <= 0.05)) return false;  // as check_rate() has it
  Eigen::VectorXd even(size);
  for (Eigen::Index first = 0, end = 0; first < size; first = end) {
    end = stretch_end(first);
    const double mean = r.time.segment(first, end - first).mean();
    for (Eigen::Index i = first; i < end; ++i)
      even[i] = mean + period * (static_cast<double>(i) - middle(first, end));
  }
  if ((even - r.time).cwiseAbs().maxCoeff() > kFarthestStamp * period) return false;
  const double jitter = std::sqrt((even - r.time).squaredNorm() / static_cast<double>(size));
  r.notes.push_back("the times jitter by " + shown_rounded(1e3 * jitter) + " ms about " +
                    shown_rounded(1.0 / period) + " Hz: each row is moved to its even time");
  r.time = even;
  return true;
}

/// Largest share of rows that may step unevenly without a word.
inline constexpr double kMostUneven = 0.02;

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
