// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <stdexcept>
#include <string>

#include "diabolo/robot/arm/chain.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Lengths of a UR5e [m], Denavit-Hartenberg as Universal Robots publishes them; the same letters serve any
/// arm of that build. The frame of the base is the controller's, "base"; ROS turns it by pi about z.
struct Ur5eLengths {
  double d1 = 0.1625, a2 = -0.425, a3 = -0.3922, d4 = 0.1333, d5 = 0.0997, d6 = 0.0996;
};

/// What a UR5e's joints can do, by its data sheet; it names no limit of the acceleration.
inline constexpr double kUr5eJointSpeed = kPi;  ///< [rad/s]
/// The elbow turns no further than half a turn before the arm meets itself.
inline constexpr JointRanges kUr5eRanges{{-2 * kPi, -2 * kPi, -kPi, -2 * kPi, -2 * kPi, -2 * kPi},
                                         {2 * kPi, 2 * kPi, kPi, 2 * kPi, 2 * kPi, 2 * kPi}};

/// The UR5e of the data sheet.
template <class Scalar>
Chain<Scalar> ur5e_nominal(const Ur5eLengths& lengths = {}) {
  const Scalar zero(0), one(1);
  const Matrix3<Scalar> quarter = rotation_x(zero, one), back = rotation_x(zero, Scalar(-1));
  const Matrix3<Scalar> straight = Matrix3<Scalar>::Identity();
  typename Chain<Scalar>::Links links;
  links[0] = {straight, {zero, zero, Scalar(lengths.d1)}};
  links[1] = {quarter, {zero, zero, zero}};
  links[2] = {straight, {Scalar(lengths.a2), zero, zero}};
  links[3] = {straight, {Scalar(lengths.a3), zero, Scalar(lengths.d4)}};
  links[4] = {quarter, {zero, Scalar(-lengths.d5), zero}};
  links[5] = {back, {zero, Scalar(lengths.d6), zero}};
  return Chain<Scalar>(links);
}

/// How one link stands against the one before, a row of the calibration that the ROS driver extracts.
struct LinkCalibration {
  double x = 0, y = 0, z = 0;           ///< [m]
  double roll = 0, pitch = 0, yaw = 0;  ///< [rad]
};
/// shoulder, upper arm, forearm, wrist 1, wrist 2, wrist 3.
using Ur5eCalibration = std::array<LinkCalibration, kJointCount>;

/// The calibration that a UR5e of the data sheet has.
inline Ur5eCalibration nominal_calibration(const Ur5eLengths& lengths = {}) {
  const double half = kPi / 2;
  return {{{0, 0, lengths.d1, 0, 0, 0},
           {0, 0, 0, half, 0, 0},
           {lengths.a2, 0, 0, 0, 0, 0},
           {lengths.a3, 0, lengths.d4, 0, 0, 0},
           {0, -lengths.d5, 0, half, 0, 0},
           {0, lengths.d6, 0, -half, 0, 0}}};
}

/// A UR5e as its maker measured it. Throws std::invalid_argument that names the link and the number where one
/// is not finite, or a link is farther than 1 m from the one before.
template <class Scalar>
Chain<Scalar> ur5e_from_calibration(const Ur5eCalibration& calibration) {
  typename Chain<Scalar>::Links links;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const LinkCalibration& link = calibration[i];
    for (const double number : {link.x, link.y, link.z, link.roll, link.pitch, link.yaw})
      if (!std::isfinite(number))
        throw std::invalid_argument("calibration, link " + std::to_string(i + 1) + ": " + shown(number) +
                                    "; must be finite");
    const double reach = std::sqrt(link.x * link.x + link.y * link.y + link.z * link.z);
    if (reach > 1.0)
      throw std::invalid_argument("calibration, link " + std::to_string(i + 1) + ": " + shown(reach) +
                                  " m from the link before; must be within 1 m");
    links[i] = Pose<Scalar>::from_roll_pitch_yaw({Scalar(link.x), Scalar(link.y), Scalar(link.z)},
                                                 Scalar(link.roll), Scalar(link.pitch), Scalar(link.yaw));
  }
  return Chain<Scalar>(links);
}

}  // namespace diabolo
