// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/parameters.hpp"

namespace diabolo {

/// Spin after the axle has slipped for a while: r dw/dt = k (u - r w), with u the speed of the string over
/// the axle [m/s] and k the spin coupling [1/s]. Second order, and without overshoot however long the
/// `duration` [s] (the exponential's Pade approximant 1 / (1 + z + z^2 / 2), z = k dt).
template <class Scalar>
Scalar spin_after_slip(const Scalar& spin, const Scalar& string_speed, const Scalar& duration,
                       const Parameters<Scalar>& parameters) {
  const Scalar z = parameters.spin_coupling * duration;
  const Scalar growth = z + Scalar(0.5) * z * z;
  return spin + (string_speed / parameters.axle_radius - spin) * (growth / (Scalar(1) + growth));
}

}  // namespace diabolo
