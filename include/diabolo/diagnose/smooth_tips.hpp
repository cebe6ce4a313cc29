// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "diabolo/math/bootstrap.hpp"
#include "diabolo/math/solve_symmetric.hpp"
#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// Acceleration by the noise of a smoothed tip that a simulation may see [m/s^2]. A rigid string follows its
/// tips: more of it would let the string go slack and snap with the camera's noise, which takes energy like a
/// drag.
inline constexpr double kTipNoiseAcceleration = 0.55;

/// Standard deviation of the white noise of a track, one coordinate [m]: the median of its third differences,
/// to which motions below a tenth of the rate add little.
inline double white_noise(const Track& track) {
  std::vector<double> sizes;
  for (Eigen::Index i = 0; i + 3 < track.valid.size(); ++i) {
    if (!track.valid.segment(i, 4).all()) continue;
    const Eigen::Vector3d third = track.position.col(i + 3) - 3.0 * track.position.col(i + 2) +
                                  3.0 * track.position.col(i + 1) - track.position.col(i);
    for (int k = 0; k < 3; ++k) sizes.push_back(std::abs(third[k]));
  }
  if (sizes.size() < 30) return 0.0;
  return kMedianToDeviation * median_of(std::move(sizes)) / std::sqrt(20.0);
}

/// Half width of the window in rows at which the noise [m] becomes kTipNoiseAcceleration. The second
/// difference of a track through local quartics under Tukey's biweight over 2 h + 1 rows has the variance
/// 40000 noise^2 rate^4 / (2 h + 2)^5, nearly.
inline int smoothing_half_width(double noise, double rate) {
  const double rows = std::pow(40000.0 * std::pow(noise * rate * rate / kTipNoiseAcceleration, 2.0), 0.2);
  return static_cast<int>(std::clamp(std::ceil(rows / 2.0 - 1.0), 1.0, std::max(1.0, 0.18 * rate)));
}

/// The track through local quartics under Tukey's biweight (no delay). They lose less of a hand's motion than
/// parabolas that are as quiet: of 4 Hz 0.4 in place of 1.1 % at 100 Hz and 0.5 mm of noise. Rows without a
/// sample stay so.
inline Track smoothed(const Track& track, double rate) {
  constexpr int kTerms = 5;
  const Eigen::Index half = smoothing_half_width(white_noise(track), rate), size = track.valid.size();
  Track result = track;
  if (half < 3) return result;
  for (Eigen::Index i = 0; i < size; ++i) {
    if (!track.valid[i]) continue;
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(kTerms, kTerms), sums = Eigen::MatrixXd::Zero(kTerms, 3);
    int used = 0;
    for (Eigen::Index j = std::max<Eigen::Index>(0, i - half); j <= std::min(size - 1, i + half); ++j) {
      if (!track.valid[j]) continue;
      const double x = static_cast<double>(j - i) / static_cast<double>(half + 1);
      const double weight = (1.0 - x * x) * (1.0 - x * x);
      const Eigen::Vector<double, kTerms> powers(1.0, x, x * x, x * x * x, x * x * x * x);
      normal += weight * powers * powers.transpose();
      sums += weight * powers * track.position.col(j).transpose();
      ++used;
    }
    if (used > kTerms) result.position.col(i) = solve_symmetric(normal, sums).row(0).transpose();
  }
  return result;
}

}  // namespace diabolo
