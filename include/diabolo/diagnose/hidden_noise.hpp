// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "diabolo/diagnose/window_system.hpp"
#include "diabolo/math/bootstrap.hpp"
#include "diabolo/recording/track_noise.hpp"

namespace diabolo {

namespace diagnose_detail {

/// Times [s] between the rows of third differences. Noise that lives for less keeps its size in them; a swing
/// of 2 Hz keeps (2 sin(2 pi time))^3 of its own, over the sqrt(20) of white noise: an eighth and a third.
/// The longer one is asked only of tracks that are smoother than kVeryHidden.
inline constexpr std::array<double, 2> kBesideMotion{1.0 / 15.0, 1.0 / 10.0};
inline constexpr double kVeryHidden = 8.0;  ///< of growth_of_differences()

/// Standard deviation of what windows leave over along an axis, from the median of its third differences over
/// so many rows; zero where they take fewer than 30.
inline double third_difference_size(const WindowSystem* systems, std::size_t count, int axis,
                                    Eigen::Index stride) {
  std::vector<double> sizes;
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Matrix3Xd& left = systems[k].residuals;
    for (Eigen::Index i = 0; i + 3 * stride < left.cols(); ++i) {
      const double third = left(axis, i + 3 * stride) - 3.0 * left(axis, i + 2 * stride) +
                           3.0 * left(axis, i + stride) - left(axis, i);
      if (std::isfinite(third)) sizes.push_back(std::abs(third));
    }
  }
  constexpr double kThird = 20.0;  // sum of the squares of the third difference
  if (sizes.size() < 30) return 0.0;
  return kMedianToDeviation * median_of(std::move(sizes)) / std::sqrt(kThird);
}

/// Over how many rows third differences of what windows leave do not grow with the time as those of forces
/// do, by its third power; zero where there are none. (What wanders grows by the root of the time.)
inline Eigen::Index rows_beside_motion(const WindowSystem* systems, std::size_t count, int axis, double rate,
                                       double growth) {
  constexpr double kMore = 4.0 / 3.0, kMostPower = 1.2;
  for (const double time : kBesideMotion) {
    if (time > kBesideMotion.front() && growth < kVeryHidden) break;
    const Eigen::Index rows = std::max<Eigen::Index>(1, std::lround(time * rate)),
                       more = std::max<Eigen::Index>(rows + 1, std::lround(kMore * time * rate));
    const double size = third_difference_size(systems, count, axis, rows),
                 larger = third_difference_size(systems, count, axis, more),
                 ratio = static_cast<double>(more) / static_cast<double>(rows);
    if (larger > 0.0 && larger <= std::pow(ratio, kMostPower) * size) return rows;
  }
  return 0;
}

/// Noise of a track whose rows hide it: what a fit leaves over, where that is not what forces leave. It lives
/// for as many rows as its differences take to grow.
inline TrackNoise noise_beside_motion(TrackNoise noise, const WindowSystem* systems, std::size_t count,
                                      double rate, double growth) {
  constexpr double kGrown = 0.7;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Index most = rows_beside_motion(systems, count, axis, rate, growth);
    const double size = most > 0 ? third_difference_size(systems, count, axis, most) : 0.0;
    if (!(size > noise.deviation[axis])) continue;
    Eigen::Index rows = 1;
    while (rows < most && third_difference_size(systems, count, axis, rows) < kGrown * size) ++rows;
    noise.deviation[axis] = size;
    noise.correlation[axis] = static_cast<double>(rows - 1) / static_cast<double>(rows + 1);
  }
  return noise;
}

}  // namespace diagnose_detail

}  // namespace diabolo
