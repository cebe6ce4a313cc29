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

#include "diabolo/math/cubic_spline.hpp"
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
  Scalar time{0};  ///< [s]. Only FormulaLaws look at it.
};

/// The tips at `share` of a time [s] that begins with `begin` and ends with the velocities of `end`, which
/// change evenly.
template <class Scalar>
Tips<Scalar> tips_between(const Tips<Scalar>& begin, const Tips<Scalar>& end, double share, double time) {
  Tips<Scalar> tips = begin;
  const auto move = [&](Vector3<Scalar>& place, Vector3<Scalar>& velocity, const Vector3<Scalar>& last) {
    const Vector3<Scalar> gained = last - velocity;
    place = place + (velocity + gained * Scalar(0.5 * share)) * Scalar(time * share);
    velocity = velocity + gained * Scalar(share);
  };
  move(tips.left, tips.left_velocity, end.left_velocity);
  move(tips.right, tips.right_velocity, end.right_velocity);
  tips.time = begin.time + Scalar(time * share);
  return tips;
}

/// Whether it may be a stick's direction: of norm one within 1e-6, or zero.
template <class Scalar>
bool is_direction(const Vector3<Scalar>& v) {
  const Scalar square = squared_norm(v);
  return all(square == Scalar(0) || absolute<Scalar>(square - Scalar(1)) < Scalar(2e-6));
}

/// How tips are read between the given instants.
enum class Interpolation {
  kHeld,    ///< each pose is held until the next one (the published program)
  kLinear,  ///< straight lines; at an instant the velocity of the line that ends there
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
    values_.resize(times_.size());
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] << left[i], right[i];
    if (interpolation_ != Interpolation::kSpline) return;
    std::vector<double> steps;
    for (std::size_t i = 0; i + 1 < times_.size(); ++i) steps.push_back(times_[i + 1] - times_[i]);
    curvatures_ = spline_curvatures(steps, values_);
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

  /// What Tips::time is at time zero [s]; zero, where nothing is said.
  void start_clock(double clock) { clock_ = clock; }
  double clock() const { return clock_; }

  double begin() const { return times_.front(); }  ///< [s]
  double end() const { return times_.back(); }     ///< [s]
  std::size_t size() const { return times_.size(); }
  const std::vector<double>& times() const { return times_; }  ///< [s]
  Interpolation interpolation() const { return interpolation_; }

  /// What was given for instant number `i`, as tips at rest.
  Tips<Scalar> pose(std::size_t i) const {
    Tips<Scalar> tips;
    tips.time = Scalar(times_[i] + clock_);
    tips.left = values_[i].template head<3>();
    tips.right = values_[i].template tail<3>();
    if (directions_.empty()) return tips;
    tips.left_direction = directions_[i].template head<3>();
    tips.right_direction = directions_[i].template tail<3>();
    return tips;
  }

  /// Tips at a time [s]. `hint` speeds up sequential reading: pass the same variable again.
  Tips<Scalar> at(double time, std::size_t& hint) const {
    Tips<Scalar> tips = read(time, hint);
    tips.time = Scalar(time + clock_);
    return tips;
  }

  Tips<Scalar> at(double time) const {
    std::size_t hint = 0;
    return at(time, hint);
  }

 private:
  using Vector6 = Eigen::Matrix<Scalar, 6, 1>;  ///< left tip over right tip

  Tips<Scalar> read(double time, std::size_t& hint) const {
    // The first and the last instant belong to the motion; rounding of begin + i * dt does not decide that.
    const double rounding =
        8.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(begin()), std::abs(end()));
    const std::size_t last = times_.size() - 1;
    if (time < begin() - rounding || last == 0) return pose(0);
    if (time > end() + rounding) return pose(last);
    time = std::max(time, begin());
    if (time >= end()) return interpolation_ == Interpolation::kHeld ? pose(last) : between(last - 1, end());
    // At an instant between two straight lines the tips still move as they came: a step that ends there has
    // moved them so. As fast as they go on, they would hold a diabolo that flies off.
    const double came = interpolation_ == Interpolation::kLinear ? std::max(time - rounding, begin()) : time;
    std::size_t i = hint + 1 < times_.size() ? hint : 0;
    if (times_[i] > came)
      i = static_cast<std::size_t>(std::ranges::upper_bound(times_, came) - times_.begin()) - 1;
    while (times_[i + 1] <= came) ++i;
    hint = i;
    if (interpolation_ == Interpolation::kHeld) return pose(i);
    return between(i, time);
  }

  static Vector3<Scalar> unit_or_zero(const Vector3<Scalar>& v) { return v * Scalar(Scalar(1) / norm(v)); }

  Tips<Scalar> between(std::size_t i, double time) const {
    const double h = times_[i + 1] - times_[i];
    const double v = (time - times_[i]) / h, u = 1.0 - v;
    const Vector6 &a = values_[i], &b = values_[i + 1];
    const SplinePoint<Vector6> point =
        interpolation_ == Interpolation::kSpline
            ? spline_point(a, b, curvatures_[i], curvatures_[i + 1], h, v)
            : SplinePoint<Vector6>{a * Scalar(u) + b * Scalar(v), (b - a) * Scalar(1.0 / h)};
    Tips<Scalar> tips;
    tips.left = point.value.template head<3>();
    tips.right = point.value.template tail<3>();
    tips.left_velocity = point.rate.template head<3>();
    tips.right_velocity = point.rate.template tail<3>();
    if (directions_.empty()) return tips;
    const Vector6 direction = directions_[i] * Scalar(u) + directions_[i + 1] * Scalar(v);
    tips.left_direction = unit_or_zero(direction.template head<3>());
    tips.right_direction = unit_or_zero(direction.template tail<3>());
    return tips;
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

  double clock_ = 0.0;
  Interpolation interpolation_;
  std::vector<double> times_;
  std::vector<Vector6> values_, curvatures_;  ///< second derivatives [m/s^2]; of a spline only
  std::vector<Vector6> directions_;           ///< of the sticks, left over right; empty where not given
};

}  // namespace diabolo
