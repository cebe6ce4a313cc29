// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "diabolo/math/scalar.hpp"

namespace diabolo {

/// The auxiliary spheroid of the paper (section III-A): the points that a diabolo reaches when the string
/// between the two stick tips is taut. The tips are its foci, the string's length is its major axis; every
/// point on it has path length |p - left| + |p - right| == string_length.
///
/// The printed formula of the semi-minor axis lacks a square; here b^2 = (L/2)^2 - (D/2)^2. Regular for
/// coinciding tips (a sphere) and for tips nearly L apart; for tips farther apart than the string there is no
/// spheroid
/// (`overstretched`), and the segment between the tips takes its place.
template <class Scalar>
class Spheroid {
 public:
  /// Tips [m] and string length [m], all in one frame.
  Spheroid(const Vector3<Scalar>& left, const Vector3<Scalar>& right, const Scalar& string_length)
      : left_(left), right_(right), string_length_(string_length), center_((left + right) * Scalar(0.5)) {
    const Vector3<Scalar> span = left - right;
    tip_distance_ = norm<Scalar>(span);
    // Zero, not a shortened vector, where the span is so small that norm() rounds it up.
    const Scalar smallest = tiny<Scalar>() / Scalar(std::numeric_limits<ValueOf<Scalar>>::epsilon());
    axis_ = span * select(squared_norm(span) > smallest, Scalar(Scalar(1) / tip_distance_), Scalar(0));
    const Scalar half_span = Scalar(0.5) * tip_distance_;
    semi_major_ = maximum(Scalar(Scalar(0.5) * string_length), half_span);
    const Scalar semi_minor_squared = (semi_major_ - half_span) * (semi_major_ + half_span);
    const Scalar thinnest = Scalar(kThinnest) * semi_major_;
    semi_minor_ = positive_sqrt<Scalar>(maximum(semi_minor_squared, Scalar(thinnest * thinnest)));
  }

  const Vector3<Scalar>& left() const { return left_; }
  const Vector3<Scalar>& right() const { return right_; }
  const Vector3<Scalar>& center() const { return center_; }  ///< midpoint of the tips [m]
  const Vector3<Scalar>& axis() const { return axis_; }  ///< unit, from right to left tip; 0 if they coincide
  const Scalar& tip_distance() const { return tip_distance_; }    ///< D [m]
  const Scalar& string_length() const { return string_length_; }  ///< L [m]
  const Scalar& semi_major() const { return semi_major_; }        ///< L/2 [m] (D/2 when overstretched)
  const Scalar& semi_minor() const { return semi_minor_; }  ///< [m], never below 1e-10 of the semi-major axis
  Mask<Scalar> overstretched() const { return tip_distance_ >= string_length_; }

  /// |p - left| + |p - right| [m].
  Scalar path_length(const Vector3<Scalar>& point) const {
    return norm<Scalar>(point - left_) + norm<Scalar>(point - right_);
  }

  /// Derivative of the path length with respect to the point: the sum of the unit vectors from the tips, of
  /// norm 2 cos(half the angle between the string's segments).
  Vector3<Scalar> path_gradient(const Vector3<Scalar>& point) const {
    return unit(point - left_) + unit(point - right_);
  }

  /// Whether the point can be reached without stretching the string.
  Mask<Scalar> contains(const Vector3<Scalar>& point) const { return path_length(point) <= string_length_; }

  /// Distance to the surface [m], positive inside (the paper's s).
  Scalar signed_distance(const Vector3<Scalar>& point) const {
    const Scalar distance = norm<Scalar>(point - closest_point(point));
    return select(contains(point), distance, Scalar(-distance));
  }

  /// The point of the surface that is closest to the given one (of equally close ones, the lower one).
  Vector3<Scalar> closest_point(const Vector3<Scalar>& point) const {
    const Local local = to_local(point);
    const Scalar along = absolute(local.along) / semi_major_;
    const Scalar across = local.across / semi_major_;
    const Scalar b = semi_minor_ / semi_major_;
    const Scalar eccentricity = Scalar(0.5) * tip_distance_ / semi_major_;
    const Scalar e2 = eccentricity * eccentricity;
    const Scalar s = closest_point_parameter(along, across, b, e2);
    const Scalar along_surface = along / maximum(Scalar(s + e2), tiny<Scalar>());
    // Near the vertices b^2 v / s keeps the digits; between the centres of curvature, on the axis, it is 0/0.
    const Scalar across_surface =
        select(along > e2, Scalar(b * b * across / maximum(s, tiny<Scalar>())),
               Scalar(b * positive_sqrt<Scalar>((Scalar(1) - along_surface) * (Scalar(1) + along_surface))));
    const Scalar sign = select(local.along < Scalar(0), Scalar(-semi_major_), semi_major_);
    return center_ + axis_ * (sign * along_surface) + local.direction * (across_surface * semi_major_);
  }

  /// The point where the ray from the centre through the given point leaves the spheroid (the published
  /// program's projection).
  Vector3<Scalar> radial_point(const Vector3<Scalar>& point) const {
    const Local local = to_local(point);
    const Scalar along = local.along / semi_major_;
    const Scalar across = local.across / semi_minor_;
    return center_ + (point - center_) / norm2(along, across);
  }

  /// Outward unit normal of the surface through the point that has the same foci: (x/b^2, y/a^2, z/b^2) on
  /// the spheroid itself.
  Vector3<Scalar> normal(const Vector3<Scalar>& point) const {
    const Vector3<Scalar> gradient = path_gradient(point);
    return gradient / norm<Scalar>(gradient);
  }

  /// The direction (x/b, y/a, z/b) that the published program uses for the normal; a unit vector.
  Vector3<Scalar> published_normal(const Vector3<Scalar>& point) const {
    const Vector3<Scalar> offset = point - center_;
    const Scalar along = dot<Scalar>(offset, axis_);
    const Vector3<Scalar> direction = (offset - axis_ * along) / semi_minor_ + axis_ * (along / semi_major_);
    return direction / norm<Scalar>(direction);
  }

 private:
  static constexpr double kThinnest = 1e-10;
  static constexpr int kMaximumIterations = 64;

  struct Local {
    Scalar along;               ///< component along the axis [m]
    Scalar across;              ///< distance from the axis [m], >= 0
    Vector3<Scalar> direction;  ///< unit vector away from the axis
  };

  static Vector3<Scalar> unit(const Vector3<Scalar>& v) { return v / norm<Scalar>(v); }
  static Scalar norm2(const Scalar& x, const Scalar& y) { return positive_sqrt<Scalar>(x * x + y * y); }

  Local to_local(const Vector3<Scalar>& point) const {
    const Vector3<Scalar> offset = point - center_;
    const Scalar along = dot<Scalar>(offset, axis_);
    const Vector3<Scalar> radial = offset - axis_ * along;
    const Scalar across = norm<Scalar>(radial);
    const Mask<Scalar> on_axis =
        across < Scalar(8.0 * std::numeric_limits<ValueOf<Scalar>>::epsilon()) * semi_major_;
    return {along, across, select<Scalar>(on_axis, lowest_direction(), radial / across)};
  }

  /// Unit vector across the axis that points most downwards.
  Vector3<Scalar> lowest_direction() const {
    const Vector3<Scalar> forward(Scalar(1), Scalar(0), Scalar(0)), down(Scalar(0), Scalar(0), Scalar(-1));
    const Mask<Scalar> upright = absolute<Scalar>(axis_.z()) > Scalar(0.9999);
    const Vector3<Scalar> reference = select<Scalar>(upright, forward, down);
    return unit(reference - axis_ * dot<Scalar>(reference, axis_));
  }

  /// Root s > 0 of (u/(s+e^2))^2 + (b v/s)^2 = 1 (Eberly's form of the distance to an ellipse with semi-axes
  /// 1 and b, b^2 + e^2 = 1, his t being s - b^2, so that no digits cancel for a near sphere; u, v >= 0). The
  /// function is convex and falling and Newton starts left of the root, so that it comes up to it without
  /// overshooting.
  static Scalar closest_point_parameter(const Scalar& u, const Scalar& v, const Scalar& b, const Scalar& e2) {
    Scalar s = maximum(Scalar(u - e2), Scalar(b * v));
    Mask<Scalar> settled{false};
    for (int i = 0; i < kMaximumIterations; ++i) {
      const Scalar p = Scalar(1) / maximum(Scalar(s + e2), tiny<Scalar>());
      const Scalar q = Scalar(1) / maximum(s, tiny<Scalar>());
      const Scalar up = u * p, vq = b * v * q;
      const Scalar excess = up * up + vq * vq - Scalar(1);
      const Scalar slope = Scalar(2) * (up * up * p + vq * vq * q);
      const Scalar step =
          select(slope > tiny<Scalar>(), Scalar(excess / maximum(slope, tiny<Scalar>())), Scalar(0));
      s += select(settled, Scalar(0), maximum(step, Scalar(0)));
      const Scalar resolution = Scalar(4.0 * std::numeric_limits<ValueOf<Scalar>>::epsilon()) * s;
      settled = settled || (step <= resolution);
      if (all(settled)) break;
    }
    return s;
  }

  Vector3<Scalar> left_, right_;
  Scalar string_length_;
  Vector3<Scalar> center_, axis_;
  Scalar tip_distance_, semi_major_, semi_minor_;
};

}  // namespace diabolo
