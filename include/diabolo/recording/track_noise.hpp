// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "diabolo/math/bootstrap.hpp"
#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// Noise of a track, axis by axis: its standard deviation [m], and how much of it lives on to the next frame
/// (the correlation of an AR(1) process).
struct TrackNoise {
  Eigen::Array3d deviation = Eigen::Array3d::Zero(), correlation = Eigen::Array3d::Zero();
};

namespace recording_detail {

/// Of the differences that noise is measured by: (1 - z)^6. What moves below a twentieth of the rate is
/// nearly gone from them.
inline constexpr std::array<double, 7> kDifference{1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0};

/// Variance of the difference over frames that are `stride` apart, of noise of variance one.
inline double difference_variance(double correlation, int stride) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kDifference.size(); ++i)
    for (std::size_t j = 0; j < kDifference.size(); ++j)
      sum += kDifference[i] * kDifference[j] *
             std::pow(correlation, stride * std::abs(static_cast<double>(i) - static_cast<double>(j)));
  return sum;
}

/// Standard deviation of the difference over frames that are `stride` apart, from its median, so that catches
/// and jumps count little; zero where fewer than 30 can be taken.
template <class Value>
double difference_size(const Marks& valid, Eigen::Index stride, const Value& value) {
  std::vector<double> sizes;
  for (Eigen::Index i = 0; i + 6 * stride < valid.size(); ++i) {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < 7; ++k)
      sum += valid[i + k * stride] ? kDifference[static_cast<std::size_t>(k)] * value(i + k * stride) : kNaN;
    if (std::isfinite(sum)) sizes.push_back(std::abs(sum));
  }
  if (sizes.size() < 30) return 0.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return kMedianToDeviation * *middle;
}

/// The correlation by which the differences over two frames are so many times as large as those over one.
inline double correlation_of(double ratio) {
  constexpr double kMost = 0.5;  // more is not told from motion
  double low = 0.0, high = kMost;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    const double expected = std::sqrt(difference_variance(middle, 2) / difference_variance(middle, 1));
    (expected < ratio ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace recording_detail

/// Noise of a track as the track alone shows it: by its sixth differences over one frame and over two. What
/// wanders over many frames does not show in them. Zero where the track is too short to tell.
inline TrackNoise track_noise(const Track& track) {
  TrackNoise noise;
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = [&](Eigen::Index i) { return track.position(axis, i); };
    const double near = recording_detail::difference_size(track.valid, 1, value),
                 far = recording_detail::difference_size(track.valid, 2, value);
    if (!(near > 0.0)) continue;
    noise.correlation[axis] = far > 0.0 ? recording_detail::correlation_of(far / near) : 0.0;
    noise.deviation[axis] =
        near / std::sqrt(recording_detail::difference_variance(noise.correlation[axis], 1));
  }
  return noise;
}

/// Beyond this growth_of_differences() rows hide the noise of their track.
inline constexpr double kHidden = 1.1;

/// How much larger sixth differences over a thirtieth of a second are than those over one row, over the root
/// of so many rows, on the middle axis. In AR(1) noise of any correlation that is at most 1. Beyond it the
/// track was smoothed or interpolated, or moves almost without noise. 1 where the rows are too few or too
/// slow to tell.
inline double growth_of_differences(const Track& track, double rate) {
  const Eigen::Index stride = std::max<Eigen::Index>(1, std::lround(rate / 30.0));
  std::array<double, 3> growth{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = [&](Eigen::Index i) { return track.position(axis, i); };
    const double near = recording_detail::difference_size(track.valid, 1, value),
                 far = recording_detail::difference_size(track.valid, stride, value);
    growth[static_cast<std::size_t>(axis)] =
        far > 0.0 ? far / std::sqrt(static_cast<double>(stride)) / std::max(near, 1e-12) : 1.0;
  }
  std::ranges::sort(growth);
  return growth[1];
}

/// Noise of an angle [rad] whose change per frame times the rate is the spin: of each of the two angles that
/// a spin is made of. Zero where too few are seen.
inline double angle_noise(const Eigen::VectorXd& spin, const Marks& valid, double rate) {
  constexpr double kSeventh = 3432.0;  // sum of the squares of the seventh difference
  return recording_detail::difference_size(valid, 1, [&](Eigen::Index i) { return spin[i]; }) / rate /
         std::sqrt(kSeventh);
}

/// A series of such noise.
inline Eigen::VectorXd drawn_noise(Eigen::Index size, double deviation, double correlation,
                                   std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd series(size);
  double now = normal(generator);
  for (Eigen::Index i = 0; i < size; ++i) {
    series[i] = deviation * now;
    now = correlation * now + std::sqrt(1.0 - correlation * correlation) * normal(generator);
  }
  return series;
}

}  // namespace diabolo
