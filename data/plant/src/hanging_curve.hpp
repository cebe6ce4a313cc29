// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry.hpp"

namespace plant {

/// A rope at rest between two places: a catenary, or a straight line where it is too short to sag.
class HangingCurve {
 public:
  /// `length` of the rope [m]; `up` is the unit vector against gravity.
  HangingCurve(const Vec3& from, const Vec3& to, double length, const Vec3& up)
      : from_(from), to_(to), up_(up), length_(length), is_straight_(length <= (to - from).norm() * kTaut) {
    if (is_straight_) return;
    const Vec3 chord = to - from;
    const double rise = chord.dot(up);
    const Vec3 across = chord - rise * up;
    const double span = std::max(across.norm(), 1e-3 * length);
    forward_ = across / span;
    // sinh(q) / q = sqrt(length^2 - rise^2) / span for q, half the span over the curve's scale.
    const double wanted = std::sqrt(length * length - rise * rise) / span;
    double low = 0.0;
    double high = 40.0;
    for (int i = 0; i < 80; ++i) {
      const double middle = 0.5 * (low + high);
      (std::sinh(middle) < wanted * middle ? low : high) = middle;
    }
    scale_ = 0.5 * span / high;
    lowest_ = 0.5 * span - scale_ * std::atanh(rise / length);
  }

  /// The place at a share of the rope's length from its beginning.
  Vec3 at(double share) const {
    if (is_straight_) return from_ + share * (to_ - from_);
    const double start = -lowest_ / scale_;
    const double here = std::asinh(share * length_ / scale_ + std::sinh(start));
    return from_ + scale_ * ((here - start) * forward_ + (std::cosh(here) - std::cosh(start)) * up_);
  }

 private:
  static constexpr double kTaut = 1.0 + 1e-9;

  Vec3 from_;
  Vec3 to_;
  Vec3 up_;
  double length_;
  bool is_straight_;
  Vec3 forward_ = Vec3::Zero();
  double scale_ = 1.0;   // of the catenary [m]
  double lowest_ = 0.0;  // how far forward its lowest point lies [m]
};

}  // namespace plant
