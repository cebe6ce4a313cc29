// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "diabolo/plan/stick_spline.hpp"
#include "diabolo/plan/tip_path.hpp"
#include "random.hpp"

constexpr double kLength = 1.45;  ///< of the string in these tests [m]

/// A spline through random points near a player's hands, in random times.
inline diabolo::StickSpline<double> random_spline(Random& random, diabolo::SplineEnds ends, int count = 6) {
  diabolo::StickSpline<double> spline;
  spline.ends = ends;
  spline.begin = random.uniform(-1.0, 1.0);
  for (int i = 0; i < count; ++i) {
    diabolo::TipColumn<double> point;
    point << random.vector(0.15) + diabolo::Vector3<double>(0.0, 0.3, 1.2),
        random.vector(0.15) + diabolo::Vector3<double>(0.0, -0.3, 1.2);
    spline.points.push_back(point);
    if (i > 0) spline.durations.push_back(random.uniform(0.15, 0.4));
  }
  if (ends == diabolo::SplineEnds::kPeriodic) spline.points.back() = spline.points.front();
  return spline;
}

/// Largest jump of place, velocity or acceleration between the pieces of a path [m, m/s, m/s^2].
inline double largest_jump(const diabolo::TipPath<double>& path) {
  double largest = 0.0;
  for (std::size_t i = 0; i + 1 < path.pieces().size(); ++i) {
    const auto a = path.pieces()[i].at(path.pieces()[i].duration), b = path.pieces()[i + 1].at(0.0);
    for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, (a[k] - b[k]).cwiseAbs().maxCoeff());
  }
  return largest;
}
