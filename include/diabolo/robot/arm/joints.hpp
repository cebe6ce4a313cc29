// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>

#include "diabolo/math/scalar.hpp"

namespace diabolo {

/// The six joint angles of an arm [rad], base to last wrist joint. Of the Scalar contract, the robot headers
/// take the scalars with one lane: double, float and `Dual` of them.
template <class Scalar>
using Joints = Eigen::Matrix<Scalar, 6, 1>;

inline constexpr int kJointCount = 6;
inline constexpr double kPi = std::numbers::pi;

/// Whether every angle is finite.
template <class Scalar>
bool all_finite(const Joints<Scalar>& joints) {
  for (int i = 0; i < kJointCount; ++i)
    if (!is_finite(joints[i])) return false;
  return true;
}

/// The angle plus whole turns that lies nearest to `near` [rad].
template <class Scalar>
Scalar nearest_turn(const Scalar& angle, double near) {
  return angle + Scalar(2.0 * kPi * std::round((near - plain(angle)) / (2.0 * kPi)));
}

/// The angles that each joint may take [rad].
struct JointRanges {
  std::array<double, kJointCount> lower{}, upper{};

  template <class Scalar>
  bool contain(const Joints<Scalar>& joints) const {
    for (std::size_t i = 0; i < kJointCount; ++i) {
      const double angle = plain(joints[static_cast<Eigen::Index>(i)]);
      if (!(angle >= lower[i] && angle <= upper[i])) return false;
    }
    return true;
  }
};

/// Adds whole turns to each angle so that it lies in its range and, of what lies there, nearest to `seed`;
/// false, with `joints` in no certain state, where a range holds no such angle.
template <class Scalar>
bool unwrap(Joints<Scalar>& joints, const Joints<Scalar>& seed, const JointRanges& ranges) {
  for (std::size_t k = 0; k < kJointCount; ++k) {
    const Eigen::Index i = static_cast<Eigen::Index>(k);
    Scalar angle = nearest_turn(joints[i], plain(seed[i]));
    if (plain(angle) > ranges.upper[k])
      angle -= Scalar(2.0 * kPi * std::ceil((plain(angle) - ranges.upper[k]) / (2.0 * kPi)));
    if (plain(angle) < ranges.lower[k])
      angle += Scalar(2.0 * kPi * std::ceil((ranges.lower[k] - plain(angle)) / (2.0 * kPi)));
    if (!(plain(angle) >= ranges.lower[k] && plain(angle) <= ranges.upper[k])) return false;
    joints[i] = angle;
  }
  return true;
}

}  // namespace diabolo
