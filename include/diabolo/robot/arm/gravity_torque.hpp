// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "diabolo/robot/arm/chain.hpp"

namespace diabolo {

/// A mass and where its centre lies in the frame of its link.
template <class Scalar>
struct LinkMass {
  Scalar mass = Scalar(0);                                        ///< [kg]
  Vector3<Scalar> center = Vector3<Scalar>::Constant(Scalar(0));  ///< [m]
};
template <class Scalar>
using LinkMasses = std::array<LinkMass<Scalar>, kJointCount>;

/// Masses of a UR5e as Universal Robots publishes them, moved into the frames of Chain's links. What hangs on
/// the flange goes with the last one.
template <class Scalar>
LinkMasses<Scalar> ur5e_masses() {
  const auto at = [](double mass, double x, double y, double z) {
    return LinkMass<Scalar>{Scalar(mass), {Scalar(x), Scalar(y), Scalar(z)}};
  };
  return {at(3.761, 0, -0.00193, -0.02561),     at(8.058, -0.425 + 0.2125, 0, 0.11336),
          at(2.846, -0.3922 + 0.15, 0, 0.0265), at(1.37, 0, -0.01634, -0.0018),
          at(1.3, 0, 0.01634, -0.0018),         at(0.365, 0, 0, -0.001159)};
}

/// Torque that each joint needs to hold the arm still [N m], under `gravity` [m/s^2, frame of the base].
template <class Scalar>
Joints<Scalar> gravity_torque(const Chain<Scalar>& chain, const LinkMasses<Scalar>& masses,
                              const Joints<Scalar>& joints, const Vector3<Scalar>& gravity) {
  const typename Chain<Scalar>::Links frames = chain.frames(joints);
  Joints<Scalar> torque = Joints<Scalar>::Constant(Scalar(0));
  for (std::size_t link = 0; link < kJointCount; ++link) {
    const Vector3<Scalar> center = frames[link] * masses[link].center;
    for (std::size_t i = 0; i <= link; ++i) {
      const Vector3<Scalar> axis = frames[i].rotation.col(2), arm = center - frames[i].position;
      torque[static_cast<Eigen::Index>(i)] -= masses[link].mass * dot(cross(axis, arm), gravity);
    }
  }
  return torque;
}

}  // namespace diabolo
