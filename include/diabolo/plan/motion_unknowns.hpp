// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "diabolo/plan/stick_spline.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// What a solver may change of a seed motion. The first point, where the tips are, always stays; of a loop
/// the last one too.
struct Freedom {
  bool forward = false;    ///< forward and backward (x) too; else x follows the seed
  bool times = true;       ///< the durations between the points
  bool last_point = true;  ///< of a motion that is no loop
  double reach = 0.4;      ///< of each coordinate of a control point, from the seed [m]
  double stretch = 0.25;   ///< of each duration, as a share of the seed's

  /// Throws std::invalid_argument where a bound is not positive, or a duration could come down to nothing.
  void validate() const {
    if (!(reach > 0.0) || reach > 10.0)
      throw std::invalid_argument("freedom, reach: " + shown(reach) + " m; must be positive, at most 10 m");
    if (!(stretch > 0.0 && stretch < 0.95))
      throw std::invalid_argument("freedom, stretch: " + shown(stretch) + "; must be within 0 and 0.95");
  }
};

/// The state vector of the search: control points and times that are free, as changes of the seed in units of
/// kPointUnit and kTimeUnit, so that all of them are of like size.
class MotionUnknowns {
 public:
  static constexpr double kPointUnit = 0.05;  ///< [m]
  static constexpr double kTimeUnit = 0.05;   ///< share of the duration

  MotionUnknowns(const StickSpline<double>& seed, const Freedom& freedom) : seed_(seed), freedom_(freedom) {
    seed.validate();
    freedom.validate();
    const bool last = freedom.last_point && seed.ends == SplineEnds::kClamped;
    for (std::size_t i = 1; i + (last ? 0 : 1) < seed.points.size(); ++i)
      for (int k = 0; k < 6; ++k)
        if (k % 3 != 0 || freedom.forward) coordinates_.push_back({i, k});
  }

  const StickSpline<double>& seed() const { return seed_; }
  std::size_t points() const { return coordinates_.size(); }  ///< unknown coordinates, the first ones
  std::size_t size() const { return points() + (freedom_.times ? seed_.durations.size() : 0); }

  /// Largest size of an unknown.
  double bound(std::size_t i) const {
    return i < points() ? freedom_.reach / kPointUnit : freedom_.stretch / kTimeUnit;
  }

  /// The motion at `x`, size().
  template <class Scalar>
  StickSpline<Scalar> motion(const std::vector<Scalar>& x) const {
    StickSpline<Scalar> spline;
    spline.begin = Scalar(seed_.begin);
    spline.ends = seed_.ends;
    spline.sticks = seed_.sticks;
    for (const TipColumn<double>& point : seed_.points) spline.points.push_back(point.cast<Scalar>());
    if (seed_.start)
      spline.start =
          SplineStart<Scalar>{seed_.start->velocity.cast<Scalar>(), seed_.start->acceleration.cast<Scalar>()};
    for (std::size_t i = 0; i < points(); ++i)
      spline.points[coordinates_[i].point][coordinates_[i].component] += x[i] * Scalar(kPointUnit);
    for (std::size_t i = 0; i < seed_.durations.size(); ++i) {
      const Scalar change = freedom_.times ? Scalar(x[points() + i] * Scalar(kTimeUnit)) : Scalar(0);
      spline.durations.push_back(Scalar(seed_.durations[i]) * (Scalar(1) + change));
    }
    return spline;
  }

 private:
  struct Coordinate {
    std::size_t point;
    int component;
  };
  StickSpline<double> seed_;
  Freedom freedom_;
  std::vector<Coordinate> coordinates_;
};

}  // namespace diabolo
