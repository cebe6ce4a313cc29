// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/residual_and_noise.hpp"
#include "diabolo/diagnose/significance.hpp"
#include "diabolo/math/bootstrap.hpp"
#include "diabolo/math/solve_symmetric.hpp"

namespace diabolo {

/// Neighbouring windows that agree so much better than chance [standard deviations] see something that lasts.
/// By a normal distribution noise makes one of twelve unknowns seem so in a recording of some 2600.
inline constexpr double kAgreement = 4.0;

/// The fastest oscillation that windows of half a second tell [Hz].
inline constexpr double kFastestChange = 0.9;

/// The longest time between the begins of neighbours [s].
inline constexpr double kNeighbours = 0.9;

namespace diagnose_detail {

/// What the windows say of one unknown beside its mean, in its unit, with its weight [1 / variance].
struct WindowSeries {
  std::vector<double> time, value, weight;
  std::vector<std::size_t> recording;

  std::size_t size() const { return time.size(); }
  bool neighbours(std::size_t i) const {
    return i + 1 < size() && recording[i] == recording[i + 1] && time[i + 1] - time[i] < kNeighbours;
  }
};

/// No window counts for more than so many times the middle one's deviations.
inline constexpr double kFarWindowsAgree = 6.0;

/// The weighted mean of a series but for windows far from its middle: one of these would make all others
/// agree.
inline double mean_of_most(const WindowSeries& series) {
  const double middle = median_of(series.value);
  std::vector<double> sizes;
  for (std::size_t i = 0; i < series.size(); ++i)
    sizes.push_back(std::abs(series.value[i] - middle) * std::sqrt(series.weight[i]));
  const double most = kFarWindowsAgree * median_of(sizes);
  double sum = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (sizes[i] > most) continue;
    sum += series.weight[i] * series.value[i];
    weights += series.weight[i];
  }
  return sum / weights;
}

/// Of kMayChange[k], from windows without events. (A mistimed catch says nothing of what lasts.)
inline WindowSeries series_of(const std::vector<WindowFinding>& windows, std::size_t k) {
  const double scale = kMayChange[k].factor * info_of(kMayChange[k].unknown).scale;
  WindowSeries series;
  for (const WindowFinding& w : windows) {
    if (w.eventful || !(w.curvature[k] > 1e-6)) continue;
    series.time.push_back(w.begin);
    series.value.push_back(scale * w.slope[k] / w.curvature[k]);
    series.weight.push_back(w.curvature[k] / (scale * scale));
    series.recording.push_back(w.recording);
  }
  if (series.size() == 0) return series;
  const double mean = mean_of_most(series);
  for (double& value : series.value) value -= mean;
  return series;
}

/// How well neighbours agree [standard deviations], no window counting more than kFarWindowsAgree times the
/// middle one, and the root of what they agree on: the mean of their products, those counting more that know
/// more.
struct Agreement {
  double z = 0.0, size = 0.0;
};

inline Agreement agreement_of(const WindowSeries& series) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i < series.size(); ++i)
    sizes.push_back(std::abs(series.value[i]) * std::sqrt(series.weight[i]));
  if (sizes.empty()) return {};
  const double most = kFarWindowsAgree * median_of(sizes);
  int pairs = 0;
  double sum = 0.0, squares = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (!series.neighbours(i)) continue;
    const double product = std::copysign(std::min(sizes[i], most), series.value[i]) *
                           std::copysign(std::min(sizes[i + 1], most), series.value[i + 1]);
    sum += product;
    squares += product * product;
    weights += std::sqrt(series.weight[i] * series.weight[i + 1]);
    ++pairs;
  }
  if (pairs < 12) return {};
  return {sum / std::sqrt(std::max(squares, 1e-300)), std::sqrt(std::max(0.0, sum / weights))};
}

/// What is left of a series [weighted sum of squares] beside some functions of time, by least squares.
inline double left_beside(const WindowSeries& series,
                          const std::vector<std::function<double(double)>>& functions,
                          double* first = nullptr) {
  const Eigen::Index n = static_cast<Eigen::Index>(series.size());
  Eigen::MatrixXd columns(n, static_cast<Eigen::Index>(functions.size()) + 1);
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    const double root = std::sqrt(series.weight[k]);
    for (std::size_t j = 0; j < functions.size(); ++j)
      columns(i, static_cast<Eigen::Index>(j)) = root * functions[j](series.time[k]);
    columns(i, columns.cols() - 1) = root;
    values[i] = root * series.value[k];
  }
  const Eigen::VectorXd best =
      solve_symmetric(columns.transpose() * columns, columns.transpose() * values).col(0);
  if (first != nullptr) *first = best[0];
  return (values - columns * best).squaredNorm();
}

/// The frequency [Hz] of the oscillation that leaves least of a series, and what it leaves; zero where none
/// leaves less than nothing does. (What bends but once is no oscillation.)
inline std::pair<double, double> best_frequency(const WindowSeries& series) {
  std::pair<double, double> best{0.0, left_beside(series, {})};
  const double span = series.time.back() - series.time.front();
  for (int k = 15; 0.1 * k / span <= kFastestChange; ++k) {
    const double f = 0.1 * k / span, omega = 2.0 * std::numbers::pi * f;
    const double left = left_beside(series, {[omega](double t) { return std::sin(omega * t); },
                                             [omega](double t) { return std::cos(omega * t); }});
    if (left < best.second) best = {f, left};
  }
  return best;
}

/// The begin [s] of the window from which on a constant, beside another one before, leaves least of a series;
/// none where a constant throughout leaves as little. At least three windows see either.
inline std::optional<double> best_onset(const WindowSeries& series) {
  constexpr std::size_t kFewest = 3;
  std::optional<double> best;
  double least = left_beside(series, {});
  for (std::size_t i = kFewest; i + kFewest <= series.size(); ++i) {
    const double onset = series.time[i];
    const double left = left_beside(series, {[onset](double t) { return t < onset ? 0.0 : 1.0; }});
    if (left < least) best = onset, least = left;
  }
  return best;
}

/// Names the shape of a change: steady, or an oscillation that leaves clearly less; neither where both leave
/// most of it. Only where all windows are of one recording, whose clock they share.
inline void name_shape(const WindowSeries& series, ChangeInTime& change) {
  if (series.recording.front() != series.recording.back()) return;
  double slope = 0.0;
  const double all = left_beside(series, {}),
               steady = left_beside(series, {[](double t) { return t; }}, &slope);
  const auto [frequency, best] = best_frequency(series);
  if (steady < 0.7 * all && steady < 1.2 * best)
    change.trend_per_s = slope;
  else if (best < 0.7 * all)
    change.frequency_hz = frequency;
}

/// A series none of whose windows counts for more than four times the middle one.
inline WindowSeries capped(WindowSeries series) {
  std::vector<double> sorted = series.weight;
  std::ranges::sort(sorted);
  for (double& weight : series.weight) weight = std::min(weight, 4.0 * quantile(sorted, 0.5));
  return series;
}

/// A steady change [unit / s], and by how many standard deviations it is one, as the windows scatter around
/// it (White's).
struct Trend {
  double rate = 0.0, z = 0.0;
};
inline Trend trend_of(const WindowSeries& series) {
  double weights = 0.0, times = 0.0, values = 0.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    weights += series.weight[i];
    times += series.weight[i] * series.time[i];
    values += series.weight[i] * series.value[i];
  }
  double spread = 0.0, product = 0.0, scatter = 0.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double since = series.time[i] - times / weights;
    spread += series.weight[i] * since * since;
    product += series.weight[i] * since * series.value[i];
  }
  const double rate = product / spread;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double since = series.time[i] - times / weights;
    scatter += std::pow(series.weight[i] * since * (series.value[i] - values / weights - rate * since), 2);
  }
  return {rate, std::abs(product) / std::sqrt(std::max(scatter, 1e-300))};
}

/// Whether a line leaves less of a series than a step does.
inline bool is_no_step(const WindowSeries& series) {
  const std::optional<double> onset = best_onset(series);
  return !onset || left_beside(series, {[](double t) { return t; }}) <
                       left_beside(series, {[onset](double t) { return t < *onset ? 0.0 : 1.0; }});
}

/// Clocks that drift apart: in a single recording a delay that changes steadily, rather than at once or to
/// and fro, surely, and by more than it may be off by.
inline std::optional<ChangeInTime> drifting_clocks(const WindowSeries& given, const MayChange& delay) {
  constexpr double kLeast = 3.0;        // of the whole of it, in the smallest change that matters
  constexpr std::size_t kWindows = 12;  // to tell
  if (given.size() < kWindows || given.recording.front() != given.recording.back()) return std::nullopt;
  const WindowSeries series = capped(given);
  const Trend trend = trend_of(series);
  const double whole = std::abs(trend.rate) * (series.time.back() - series.time.front());
  if (!(trend.z > kStrong) || !(whole > kLeast * delay.smallest)) return std::nullopt;
  ChangeInTime change;
  change.quantity = delay.name;
  change.unit = delay.unit;
  change.z = trend.z;
  change.size = whole / std::sqrt(12.0);  // root mean square about its middle
  name_shape(series, change);
  return change.trend_per_s && is_no_step(series) ? std::optional(change) : std::nullopt;
}

}  // namespace diagnose_detail

/// Unknowns of which neighbouring windows say the same, and others something else, by as much as matters: the
/// surest first. What no name explains shows here long before it shows in the size of what is left.
inline std::vector<ChangeInTime> changes_in_time(const std::vector<WindowFinding>& windows) {
  std::vector<ChangeInTime> result;
  for (std::size_t k = 0; k < kMayChange.size(); ++k) {
    const diagnose_detail::WindowSeries series = diagnose_detail::series_of(windows, k);
    if (kMayChange[k].unknown == Unknown::kTimeOffset) {
      if (const auto drift = diagnose_detail::drifting_clocks(series, kMayChange[k]))
        result.push_back(*drift);
      continue;
    }
    const diagnose_detail::Agreement agreement = diagnose_detail::agreement_of(series);
    if (!(agreement.z > kAgreement && agreement.size > kMayChange[k].smallest)) continue;
    ChangeInTime change;
    change.quantity = kMayChange[k].name;
    change.unit = kMayChange[k].unit;
    change.z = agreement.z;
    change.size = agreement.size;
    diagnose_detail::name_shape(series, change);
    result.push_back(change);
  }
  std::ranges::stable_sort(result, std::greater(), &ChangeInTime::z);
  return result;
}

}  // namespace diabolo
