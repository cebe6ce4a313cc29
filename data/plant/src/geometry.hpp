// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>

namespace plant {

using Vec3 = Eigen::Vector3d;

/// One value per stick: [0] left, [1] right.
template <typename T>
using Pair = std::array<T, 2>;

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

/// Rotates `vector`, which is perpendicular to the unit vector `axis`, about it by `angle` [rad].
inline Vec3 rotate_in_plane(const Vec3& vector, const Vec3& axis, double angle) {
  return std::cos(angle) * vector + std::sin(angle) * axis.cross(vector);
}

/// Unit vector at `yaw` (to the left) and `pitch` (up) [rad] from world x (forward).
inline Vec3 direction_from_angles(double yaw, double pitch) {
  return {std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch)};
}

/// The part of `vector` perpendicular to the unit vector `axis`.
inline Vec3 perpendicular_part(const Vec3& vector, const Vec3& axis) {
  return vector - vector.dot(axis) * axis;
}

}  // namespace plant
