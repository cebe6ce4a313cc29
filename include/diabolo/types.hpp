// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace diabolo {

/// A column of three components; positions in [m], world frame x forward (away from the player), y left, z up.
template <class Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;

/// Standard acceleration of gravity [m/s^2] (ISO 80000-3).
inline constexpr double kStandardGravity = 9.80665;

}  // namespace diabolo
