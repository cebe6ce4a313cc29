// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/math/cubic_spline.hpp"
#include "diabolo/robot/arm/joint_limits.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A curve through joints given one tick apart: a natural cubic spline, so that its acceleration is
/// continuous.
class JointPath {
 public:
  static constexpr double kMostTurn = 1e3;  ///< of a joint [rad]

  /// Throws std::invalid_argument where there are less than four points, or an angle is beyond kMostTurn.
  explicit JointPath(std::vector<PairJoints> points) : points_(std::move(points)) {
    const std::size_t n = points_.size();
    if (n < 4)
      throw std::invalid_argument("joint path: " + std::to_string(n) + " points; must be four or more");
    for (std::size_t i = 0; i < n; ++i)
      for (const double angle : points_[i])
        if (!(std::abs(angle) <= kMostTurn))
          throw std::invalid_argument("joint path, point " + std::to_string(i) + ": " + shown(angle) +
                                      " rad; expected " + shown(kMostTurn) + " rad at most");
    curvatures_ = spline_curvatures(std::vector<double>(n - 1, kTick), points_);
  }

  double length() const { return static_cast<double>(points_.size() - 1) * kTick; }  ///< [s]
  const std::vector<PairJoints>& points() const { return points_; }

  /// At a time since the first point [s]; before the first and after the last one, at rest there.
  PairJoints at(double time) const {
    const double last = static_cast<double>(points_.size() - 1);
    const double place = std::clamp(time / kTick, 0.0, last);
    const std::size_t i = static_cast<std::size_t>(std::min(place, last - 1));
    return spline_point(points_[i], points_[i + 1], curvatures_[i], curvatures_[i + 1], kTick,
                        place - static_cast<double>(i))
        .value;
  }

 private:
  std::vector<PairJoints> points_, curvatures_;
};

}  // namespace diabolo
