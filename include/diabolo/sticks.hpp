// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/math/scalar.hpp"

namespace diabolo {

/// The two stick tips at an instant, world frame.
template <class Scalar>
struct Tips {
  Vector3<Scalar> left = Vector3<Scalar>::Constant(Scalar(0));            ///< [m]
  Vector3<Scalar> right = Vector3<Scalar>::Constant(Scalar(0));           ///< [m]
  Vector3<Scalar> left_velocity = Vector3<Scalar>::Constant(Scalar(0));   ///< [m/s]
  Vector3<Scalar> right_velocity = Vector3<Scalar>::Constant(Scalar(0));  ///< [m/s]
  /// Of the sticks, unit vectors; zero where they are not known. Only StickFlex looks at them.
  Vector3<Scalar> left_direction = Vector3<Scalar>::Constant(Scalar(0)),
                  right_direction = Vector3<Scalar>::Constant(Scalar(0));
};

/// Whether it may be a stick's direction: of norm one within 1e-6, or zero.
template <class Scalar>
bool is_direction(const Vector3<Scalar>& v) {
  const Scalar square = squared_norm(v);
  return all(square == Scalar(0) || absolute<Scalar>(square - Scalar(1)) < Scalar(2e-6));
}

/// How tips are read between the given instants.
enum class Interpolation {
  kHeld,    ///< each pose is held until the next one (the published program)
  kLinear,  ///< straight lines
  kSpline,  ///< natural cubic spline: continuous velocity and acceleration
};

/// Their names, in the order of their numbers from 0.
inline constexpr std::array<std::string_view, 3> names_of(Interpolation) {
  return {"held", "linear", "spline"};
}

/// Tip motion given at any increasing instants; before the first and after the last one the tips rest.
template <class Scalar>
class TipMotion {
 public:
  /// `times` [s], strictly increasing, at least one; as many left and right tips [m], world frame.
  /// Throws std::invalid_argument when the sizes differ, a time does not increase, or a number is not finite.
  TipMotion(std::vector<double> times, const std::vector<Vector3<Scalar>>& left,
            const std::vector<Vector3<Scalar>>& right, Interpolation interpolation)
      : interpolation_(interpolation), times_(std::move(times)) {
    check(left, right);
    knots_.resize(times_.size());
    for (std::size_t i = 0; i < knots_.size(); ++i) knots_[i].value << left[i], right[i];
    if (interpolation_ == Interpolation::kSpline) solve_spline();
  }

  /// Gives the sticks' directions at the instants, unit vectors, or zero where not known; in between, unit
  /// vectors in the plane of the two. Throws std::invalid_argument where there are not as many as instants,
  /// or one is no is_direction().
  void point_along(const std::vector<Vector3<Scalar>>& left, const std::vector<Vector3<Scalar>>& right) {
    if (left.size() != times_.size() || right.size() != times_.size())
      throw std::invalid_argument("tip motion: " + std::to_string(times_.size()) + " instants, " +
                                  std::to_string(left.size()) + " left and " + std::to_string(right.size()) +
                                  " right directions; must be equal");
    for (std::size_t i = 0; i < times_.size(); ++i)
      if (!is_direction(left[i]) || !is_direction(right[i]))
        throw std::invalid_argument("tip motion, instant " + std::to_string(i) +
                                    ": a direction is neither a unit vector nor zero");
    directions_.resize(times_.size());
    for (std::size_t i = 0; i < times_.size(); ++i) directions_[i] << left[i], right[i];
  }

  double begin() const { return times_.front(); }  ///< [s]
  double end() const { return times_.back(); }     ///< [s]
  std::size_t size() const { return times_.size(); }
  const std::vector<double>& times() const { return times_; }  ///< [s]
  Interpolation interpolation() const { return interpolation_; }

  /// What was given for instant number `i`, as tips at rest.
  Tips<Scalar> pose(std::size_t i) const {
    Tips<Scalar> tips;
    tips.left = knots_[i].value.template head<3>();
    tips.right = knots_[i].value.template tail<3>();
    if (directions_.empty()) return tips;
    tips.left_direction = directions_[i].template head<3>();
    tips.right_direction = directions_[i].template tail<3>();
    return tips;
  }

  /// Tips at a time [s]. `hint` speeds up sequential reading: pass the same variable again.
  Tips<Scalar> at(double time, std::size_t& hint) const {
    // The first and the last instant belong to the motion; rounding of begin + i * dt does not decide that.
    const double rounding =
        8.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(begin()), std::abs(end()));
    const std::size_t last = times_.size() - 1;
    if (time < begin() - rounding || last == 0) return pose(0);
    if (time > end() + rounding) return pose(last);
    time = std::max(time, begin());
    if (time >= end()) return interpolation_ == Interpolation::kHeld ? pose(last) : between(last - 1, end());
    std::size_t i = hint + 1 < times_.size() ? hint : 0;
    if (times_[i] > time)
      i = static_cast<std::size_t>(std::ranges::upper_bound(times_, time) - times_.begin()) - 1;
    while (times_[i + 1] <= time) ++i;
    hint = i;
    if (interpolation_ == Interpolation::kHeld) return pose(i);
    return between(i, time);
  }

  Tips<Scalar> at(double time) const {
    std::size_t hint = 0;
    return at(time, hint);
  }

 private:
  using Vector6 = Eigen::Matrix<Scalar, 6, 1>;  ///< left tip over right tip
  struct Knot {
    Vector6 value, curvature = Vector6::Constant(Scalar(0));
  };

  static Vector3<Scalar> unit_or_zero(const Vector3<Scalar>& v) { return v * Scalar(Scalar(1) / norm(v)); }

  Tips<Scalar> between(std::size_t i, double time) const {
    const double h = times_[i + 1] - times_[i];
    const double v = (time - times_[i]) / h, u = 1.0 - v;
    const Knot &a = knots_[i], &b = knots_[i + 1];
    Vector6 value = a.value * Scalar(u) + b.value * Scalar(v);
    Vector6 rate = (b.value - a.value) * Scalar(1.0 / h);
    if (interpolation_ == Interpolation::kSpline) {
      const double h2 = h * h / 6.0;
      value += a.curvature * Scalar((u * u - 1.0) * u * h2) + b.curvature * Scalar((v * v - 1.0) * v * h2);
      rate += a.curvature * Scalar((1.0 - 3.0 * u * u) * h / 6.0) +
              b.curvature * Scalar((3.0 * v * v - 1.0) * h / 6.0);
    }
    Tips<Scalar> tips;
    tips.left = value.template head<3>();
    tips.right = value.template tail<3>();
    tips.left_velocity = rate.template head<3>();
    tips.right_velocity = rate.template tail<3>();
    if (directions_.empty()) return tips;
    const Vector6 direction = directions_[i] * Scalar(u) + directions_[i + 1] * Scalar(v);
    tips.left_direction = unit_or_zero(direction.template head<3>());
    tips.right_direction = unit_or_zero(direction.template tail<3>());
    return tips;
  }

  /// Second derivatives of the natural cubic spline (tridiagonal system, Thomas's algorithm).
  void solve_spline() {
    const std::size_t n = times_.size();
    if (n < 3) return;
    std::vector<double> upper(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double h0 = times_[i] - times_[i - 1], h1 = times_[i + 1] - times_[i];
      const double pivot = 2.0 * (h0 + h1) - h0 * upper[i - 1];
      upper[i] = h1 / pivot;
      const Vector6 slope1 = (knots_[i + 1].value - knots_[i].value) * Scalar(6.0 / h1);
      const Vector6 slope0 = (knots_[i].value - knots_[i - 1].value) * Scalar(6.0 / h0);
      knots_[i].curvature = (slope1 - slope0 - knots_[i - 1].curvature * Scalar(h0)) * Scalar(1.0 / pivot);
    }
    for (std::size_t i = n - 1; i-- > 1;) knots_[i].curvature -= knots_[i + 1].curvature * Scalar(upper[i]);
  }

  void check(const std::vector<Vector3<Scalar>>& left, const std::vector<Vector3<Scalar>>& right) const {
    const std::size_t n = times_.size();
    if (n == 0) throw std::invalid_argument("tip motion: no instants; at least one expected");
    if (left.size() != n || right.size() != n)
      throw std::invalid_argument("tip motion: " + std::to_string(n) + " times, " +
                                  std::to_string(left.size()) + " left tips and " +
                                  std::to_string(right.size()) + " right tips; must be equal");
    for (std::size_t i = 0; i < n; ++i) {
      const std::string where = "tip motion, instant " + std::to_string(i) + ": ";
      if (!std::isfinite(times_[i])) throw std::invalid_argument(where + "time is not a finite number");
      if (i > 0 && !(times_[i] > times_[i - 1]))
        throw std::invalid_argument(where + "time " + std::to_string(times_[i]) + " s does not come after " +
                                    std::to_string(times_[i - 1]) + " s");
      for (int k = 0; k < 3; ++k)
        if (!all(is_finite(left[i][k])) || !all(is_finite(right[i][k])))
          throw std::invalid_argument(where + "a tip is not finite; fill dropouts first");
    }
  }

  Interpolation interpolation_;
  std::vector<double> times_;
  std::vector<Knot> knots_;
  std::vector<Vector6> directions_;  ///< of the sticks, left over right; empty where not given
};

}  // namespace diabolo
