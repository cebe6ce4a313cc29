// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "diabolo/math/scalar.hpp"

namespace diabolo {

template <class Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

/// Rotation about the x axis by an angle [rad] whose cosine and sine are given; likewise y and z.
template <class Scalar>
Matrix3<Scalar> rotation_x(const Scalar& cosine, const Scalar& sine) {
  Matrix3<Scalar> r;
  r << Scalar(1), Scalar(0), Scalar(0), Scalar(0), cosine, -sine, Scalar(0), sine, cosine;
  return r;
}
template <class Scalar>
Matrix3<Scalar> rotation_y(const Scalar& cosine, const Scalar& sine) {
  Matrix3<Scalar> r;
  r << cosine, Scalar(0), sine, Scalar(0), Scalar(1), Scalar(0), -sine, Scalar(0), cosine;
  return r;
}
template <class Scalar>
Matrix3<Scalar> rotation_z(const Scalar& cosine, const Scalar& sine) {
  Matrix3<Scalar> r;
  r << cosine, -sine, Scalar(0), sine, cosine, Scalar(0), Scalar(0), Scalar(0), Scalar(1);
  return r;
}

/// Where a frame stands in another one: a point p of the frame is rotation * p + position there.
template <class Scalar>
struct Pose {
  Matrix3<Scalar> rotation = Matrix3<Scalar>::Identity();
  Vector3<Scalar> position = Vector3<Scalar>::Constant(Scalar(0));  ///< [m]

  Vector3<Scalar> operator*(const Vector3<Scalar>& point) const {
    const Vector3<Scalar> turned = rotation * point;
    return turned + position;
  }
  Pose operator*(const Pose& other) const {
    Pose result;
    result.rotation.noalias() = rotation * other.rotation;
    result.position = *this * other.position;
    return result;
  }
  Pose inverse() const {
    Pose result;
    result.rotation = rotation.transpose();
    const Vector3<Scalar> turned = result.rotation * position;
    result.position = -turned;
    return result;
  }

  /// As in URDF: moved by `position` [m], then turned by roll about x, pitch about y and yaw about z [rad],
  /// all three about fixed axes.
  static Pose from_roll_pitch_yaw(const Vector3<Scalar>& position, const Scalar& roll, const Scalar& pitch,
                                  const Scalar& yaw) {
    using std::cos;
    using std::sin;
    Pose result;
    result.rotation =
        rotation_z<Scalar>(cos(yaw), sin(yaw)) * Matrix3<Scalar>(rotation_y<Scalar>(cos(pitch), sin(pitch)) *
                                                                 rotation_x<Scalar>(cos(roll), sin(roll)));
    result.position = position;
    return result;
  }
};

/// Why a pose is none.
enum class PoseFault {
  kNone,
  kNotFinite,    ///< a number is NaN or infinite
  kNotRotation,  ///< the rotation's columns are not right-handed unit vectors at right angles
};

/// Looks at the values; rotations pass within 1e-6, in float within 1e-4.
template <class Scalar>
PoseFault check_pose(const Pose<Scalar>& pose) {
  const double tolerance = sizeof(ValueOf<Scalar>) >= sizeof(double) ? 1e-6 : 1e-4;
  Eigen::Matrix3d rotation;
  for (int row = 0; row < 3; ++row) {
    if (!is_finite(pose.position[row])) return PoseFault::kNotFinite;
    for (int column = 0; column < 3; ++column) {
      if (!is_finite(pose.rotation(row, column))) return PoseFault::kNotFinite;
      rotation(row, column) = static_cast<double>(value_of(pose.rotation(row, column)));
    }
  }
  const Eigen::Matrix3d gap = rotation.transpose() * rotation - Eigen::Matrix3d::Identity();
  const Vector3<double> x = rotation.col(0), y = rotation.col(1), z = rotation.col(2);
  const bool right_handed = dot(cross(x, y), z) > 0.0;
  return gap.cwiseAbs().maxCoeff() <= tolerance && right_handed ? PoseFault::kNone : PoseFault::kNotRotation;
}

}  // namespace diabolo
