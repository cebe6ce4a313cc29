// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <vector>

namespace diabolo {

struct Interval {
  double low, high;
};

/// Mean of a series that is not empty.
inline double mean_of(std::span<const double> series) {
  return std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
}

/// Quantile of sorted values, at least one, linear between neighbours; `level` from 0 to 1.
inline double quantile(std::span<const double> sorted, double level) {
  const double at = level * static_cast<double>(sorted.size() - 1);
  const std::size_t below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// The standard deviation of a normal variable is so many times its median absolute value.
inline constexpr double kMedianToDeviation = 1.4826;

/// Median of those values that are numbers; `otherwise` where none is.
inline double median_of(std::vector<double> values,
                        double otherwise = std::numeric_limits<double>::quiet_NaN()) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return otherwise;
  std::ranges::sort(values);
  return quantile(values, 0.5);
}

/// How far apart two values of a series still depend on each other, twice: the block length of Politis and
/// White (2004). The last lag whose autocorrelation is beyond 2 sqrt(log10(n) / n), before five in a row that
/// are not, times two; at least 1.
inline std::size_t dependence_length(std::span<const double> series) {
  constexpr std::size_t kInARow = 5;
  const std::size_t n = series.size();
  if (n < 2) return 1;
  const double mean = mean_of(series), count = static_cast<double>(n);
  const auto covariance = [&](std::size_t lag) {
    double sum = 0.0;
    for (std::size_t i = lag; i < n; ++i) sum += (series[i] - mean) * (series[i - lag] - mean);
    return sum;
  };
  const double variance = covariance(0), threshold = 2.0 * std::sqrt(std::log10(count) / count);
  if (!(variance > 1e-24 * count * mean * mean)) return 1;  // nothing but rounding
  std::size_t last = 0;
  for (std::size_t lag = 1; lag < n && lag <= last + kInARow; ++lag)
    if (std::abs(covariance(lag)) > threshold * variance) last = lag;
  return std::max<std::size_t>(1, 2 * last);
}

/// Fewest blocks from which an interval is given.
inline constexpr std::size_t kFewestBlocks = 5;

/// 95 % interval of the true mean, for a series in which values `block` or more apart are independent:
/// circular block bootstrap, percentiles expanded for the number of blocks, as Student's t would be
/// (Hesterberg 2015). On overlapping sums of noise it holds the mean in 91 to 95 % of the cases. None from
/// fewer than kFewestBlocks blocks.
inline std::optional<Interval> mean_interval(std::span<const double> series, std::size_t block,
                                             std::mt19937_64& generator) {
  constexpr std::size_t kResamples = 10000;
  const std::size_t n = series.size();
  if (block == 0 || n / block < kFewestBlocks) return std::nullopt;
  std::vector<double> sums(2 * n + 1, 0.0);  // of the series, written twice, up to each index
  for (std::size_t i = 0; i < 2 * n; ++i) sums[i + 1] = sums[i] + series[i % n];
  std::vector<double> means(kResamples);
  for (double& mean : means) {
    double sum = 0.0;
    for (std::size_t filled = 0; filled < n; filled += block) {
      const std::size_t start = static_cast<std::size_t>(generator() % n);
      sum += sums[start + std::min(block, n - filled)] - sums[start];
    }
    mean = sum / static_cast<double>(n);
  }
  std::ranges::sort(means);
  // Cornish and Fisher's expansion of Student's quantile at 97.5 %, then the level of a normal one.
  const std::size_t blocks = n / block;
  const double k = static_cast<double>(blocks), f = k - 1.0, z = 1.959963984540054;
  const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
  const double t = z + (z3 + z) / (4.0 * f) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * f * f) +
                   (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / (384.0 * f * f * f);
  const double tail = 0.5 * std::erfc(t * std::sqrt(k / f) / std::numbers::sqrt2);
  return Interval{quantile(means, tail), quantile(means, 1.0 - tail)};
}

/// What a set of errors looks like.
struct ErrorSummary {
  std::size_t windows;                 ///< how many errors, at least one
  double mean, median, percentile_90;  ///< [m]
  std::optional<Interval> mean_ci95;   ///< [m]; none where the errors are too few to tell
};

/// Summary of errors [m] in the order of their starts, values `window` or more apart sharing no data. The
/// blocks are that long, or as long as the errors are seen to depend on each other, whichever is longer. None
/// without errors.
inline std::optional<ErrorSummary> summarize(std::span<const double> errors, std::size_t window,
                                             std::mt19937_64& generator) {
  if (errors.empty()) return std::nullopt;
  std::vector<double> sorted(errors.begin(), errors.end());
  std::ranges::sort(sorted);
  return ErrorSummary{
      .windows = errors.size(),
      .mean = mean_of(errors),
      .median = quantile(sorted, 0.5),
      .percentile_90 = quantile(sorted, 0.9),
      .mean_ci95 = mean_interval(errors, std::max(window, dependence_length(errors)), generator)};
}

}  // namespace diabolo
