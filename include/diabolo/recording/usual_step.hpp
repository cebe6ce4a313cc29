// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace diabolo {

/// The median step between times [s]; there must be two at least.
inline double median_step(const Eigen::VectorXd& time) {
  Eigen::VectorXd step = time.tail(time.size() - 1) - time.head(time.size() - 1);
  double* const middle = step.data() + step.size() / 2;
  std::nth_element(step.data(), middle, step.data() + step.size());
  return *middle;
}

/// The step of which the others are multiples, but for jitter [s]: rows may be left out, most of them, too.
/// There must be two times at least. Schuster's periodogram of the steps: the sum of the cosines of their
/// phases. Of its peaks that are nearly as high as the highest, the one of lowest frequency tells the longest
/// period that fits.
inline double usual_step(const Eigen::VectorXd& time) {
  constexpr double kLongest = 1.3;         // medians
  constexpr double kShortest = 1.0 / 8.0;  // a median leaves no more rows out than that
  constexpr double kBeginOfGap = 6.0;      // medians; a longer step is a gap, of no whole periods
  constexpr double kAsHigh = 0.8;          // share of the highest peak
  constexpr double kPhase = 0.02;          // of a median from frequency to frequency [turns]
  constexpr std::size_t kMostSteps = 1000;
  const double median = median_step(time);
  std::vector<double> steps;  // medians
  for (Eigen::Index i = 0; i + 1 < time.size(); ++i)
    if (const double step = (time[i + 1] - time[i]) / median; step < kBeginOfGap) steps.push_back(step);
  std::ranges::sort(steps);
  if (const std::size_t all = steps.size(); all > kMostSteps) {  // fewer of them, spread alike
    for (std::size_t k = 0; k < kMostSteps; ++k) steps[k] = steps[k * all / kMostSteps];
    steps.resize(kMostSteps);
  }
  const auto height = [&steps](double frequency) {
    double sum = 0.0;
    for (const double step : steps) sum += std::cos(2.0 * std::numbers::pi * frequency * step);
    return sum;
  };
  constexpr double kFrequencies = (1.0 / kShortest - 1.0 / kLongest) / kPhase + 3.0;
  std::vector<double> heights(static_cast<std::size_t>(kFrequencies));
  for (std::size_t k = 0; k < heights.size(); ++k)
    heights[k] = height(1.0 / kLongest + static_cast<double>(k) * kPhase);
  const double highest = *std::ranges::max_element(heights);
  for (std::size_t k = 1; k + 1 < heights.size(); ++k) {
    const double before = heights[k - 1], here = heights[k], after = heights[k + 1];
    if (here < kAsHigh * highest || here < before || here < after) continue;
    const double bend = before - 2.0 * here + after;  // the top of the parabola through the three
    const double top = bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
    return median / (1.0 / kLongest + (static_cast<double>(k) + top) * kPhase);
  }
  return median;
}

}  // namespace diabolo
