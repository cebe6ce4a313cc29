// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "diabolo/parameters.hpp"
#include "diabolo/recording/plausibility/usual_path.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// What a sample tells about gravity. The string pulls a diabolo along the sum of the directions to the tips
/// alone, so that its acceleration is gravity + tension * pull with a tension that is never negative, and
/// gravity where the string is slack.
struct Fall {
  Eigen::Index row;
  Eigen::Vector3d acceleration;  ///< [m/s^2]
  Eigen::Vector3d pull;          ///< zero where the string is slack

  /// Acceleration that neither `gravity` [m/s^2] nor a tension explains [m/s^2].
  double residual(const Eigen::Vector3d& gravity) const {
    const Eigen::Vector3d rest = acceleration - gravity;
    const double square = pull.squaredNorm();
    return square > 0.0 ? (rest - std::max(0.0, rest.dot(pull) / square) * pull).norm() : rest.norm();
  }
};

/// Half of the time over which an acceleration is fitted [s]: noise of 0.5 mm at 120 Hz gives 0.3 m/s^2; and
/// how much shorter than the string the path is at least where it counts as slack [m].
inline constexpr double kFallHalf = 0.05, kSlackBy = 0.08;

/// Rows from one Fall to the next: all, or fewer of cameras above 150 Hz, so that work is linear in rows.
inline Eigen::Index fall_stride(double rate) {
  return std::max<Eigen::Index>(1, std::lround(kFallHalf * rate) / 6);
}

/// What samples that are seen all around tell about gravity: accelerations by least squares of parabolas, the
/// string taken to be slack where its path is shorter throughout. Empty where rows are too far apart.
inline std::vector<Fall> falls(const Recording& r) {
  const Eigen::Index half = std::max<Eigen::Index>(2, std::lround(kFallHalf * r.rate)), n = 2 * half + 1,
                     stride = fall_stride(r.rate);
  if (static_cast<double>(half) > 2.0 * kFallHalf * r.rate) return {};
  Eigen::VectorXd weight(n);  // the second derivative of the parabola through n samples, times period^2
  for (Eigen::Index k = 0; k < n; ++k) weight[k] = static_cast<double>((k - half) * (k - half));
  weight.array() -= weight.mean();
  weight *= 2.0 * r.rate * r.rate / weight.squaredNorm();
  // A string may be shorter than it is said to be.
  const double taut = std::min(r.string_length, usual_path_length(r).value_or(r.string_length));
  std::vector<Fall> result;
  Eigen::Index seen = 0, slack = 0;  // samples in a row
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (seen > 0 && !r.steps_evenly(i - 1)) seen = slack = 0;
    if (!r.left.valid[i] || !r.right.valid[i] || !r.diabolo.valid[i]) {
      seen = slack = 0;
      continue;
    }
    ++seen;
    slack = path_at(r, i).length() < taut - kSlackBy ? slack + 1 : 0;
    if (seen < n || i % stride != 0) continue;
    const Eigen::Index middle = i - half;
    const auto towards = [&](const Track& tip) {
      const Eigen::Vector3d way = tip.position.col(middle) - r.diabolo.position.col(middle);
      return Eigen::Vector3d(way / std::max(way.norm(), 1e-6));
    };
    result.push_back({middle, r.diabolo.position.middleCols(i - n + 1, n) * weight,
                      slack >= n ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                                 : Eigen::Vector3d(towards(r.left) + towards(r.right))});
  }
  return result;
}

namespace recording_plausibility_detail {

/// The middle one of values, which it reorders; there must be one at least.
inline double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

inline double median_residual(const std::vector<Fall>& falls, const Eigen::Vector3d& gravity) {
  std::vector<double> residuals;
  residuals.reserve(falls.size());
  for (const Fall& fall : falls) residuals.push_back(fall.residual(gravity));
  return median_of(residuals);
}

}  // namespace recording_plausibility_detail

/// The axis, 1 to 3 for x to z and negative for its opposite, that the motion says points up where that is
/// not z; nothing where it says so of z, or not clearly. Axes are the columns of `axes`, directions in the
/// recording. Under the true axis friction, air and noise leave a fraction of gravity; under another one at
/// least gravity itself.
inline std::optional<int> other_axis_up(const Recording& r, const std::vector<Fall>& falls,
                                        const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity()) {
  const double rows = static_cast<double>(falls.size()) * static_cast<double>(fall_stride(r.rate));
  if (falls.empty() || rows < kFewestSecondsOfNoPlay * r.rate) return {};
  // A frame keeps lengths: where the path is none of the string, something else is wrong.
  std::vector<double> paths;
  paths.reserve(falls.size());
  for (const Fall& fall : falls) paths.push_back(path_at(r, fall.row).length());
  if (const double path = recording_plausibility_detail::median_of(paths);
      path > r.string_length + kOddPathLength || path < 0.5 * r.string_length)
    return {};
  const double gravity = Parameters<double>{}.gravity;
  const auto residual = [&](int axis) {
    return recording_plausibility_detail::median_residual(
        falls, (axis > 0 ? -gravity : gravity) * axes.col(static_cast<Eigen::Index>(std::abs(axis) - 1)));
  };
  const double given = residual(3);
  if (given < 0.5 * gravity) return {};
  int best = 3;
  double least = std::min(0.5 * gravity, 0.5 * given);
  for (const int axis : {1, -1, 2, -2, -3})
    if (const double other = residual(axis); other < least) least = other, best = axis;
  if (best == 3) return {};
  return best;
}

/// Largest factor by which a diabolo seems to fall faster or slower than it should without a word: twice what
/// friction makes of it in play.
inline constexpr double kOddFall = 2.0;

/// A clause about a diabolo that falls much too fast or too slowly, in flight and across its string; else
/// empty. Only samples with a pull that leaves out a tenth of gravity or more tell.
inline std::string odd_fall(const Recording& r, const std::vector<Fall>& falls) {
  constexpr double kLeastShare = 0.1, kFewest = 0.15;  // of gravity squared; s
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const double gravity = Parameters<double>{}.gravity;
  std::vector<Fall> telling;
  std::vector<double> strengths;
  for (const Fall& fall : falls) {
    const double square = fall.pull.squaredNorm();
    const auto across = [&](const Eigen::Vector3d& v) {
      return square > 0.0 ? Eigen::Vector3d(v - fall.pull * (v.dot(fall.pull) / square)) : v;
    };
    const Eigen::Vector3d left = across(up);
    if (left.squaredNorm() < kLeastShare) continue;
    telling.push_back(fall);
    strengths.push_back(-left.dot(fall.acceleration) / left.squaredNorm());
  }
  const double rows = static_cast<double>(telling.size()) * static_cast<double>(fall_stride(r.rate));
  if (telling.size() < 20 || rows < kFewest * r.rate) return {};
  const double strength = recording_plausibility_detail::median_of(strengths);
  if (strength > gravity / kOddFall && strength < gravity * kOddFall) return {};
  if (recording_plausibility_detail::median_residual(telling, -strength * up) >
      0.5 * recording_plausibility_detail::median_residual(telling, -gravity * up))
    return {};
  return "the diabolo falls by " + shown(std::round(10.0 * strength) / 10.0) + " m/s^2 instead of " +
         shown(gravity) + ", in flight and across the string: " +
         (strength < 0.0 ? "it falls upwards"
                         : "played about " + shown(std::round(10.0 * std::sqrt(strength / gravity)) / 10.0) +
                               " times as fast (a wrong rate), or lengths in other units");
}

/// A clause about a motion in which another axis than z points up; else empty.
inline std::string odd_up(const Recording& r, const std::vector<Fall>& falls) {
  const std::optional<int> up = other_axis_up(r, falls);
  if (!up) return {};
  return "the motion says that " + std::string(*up < 0 ? "-" : "") + "xyz"[std::abs(*up) - 1] +
         " points up, not z (gravity in flight and on the string)";
}

}  // namespace diabolo
