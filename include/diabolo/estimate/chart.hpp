// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "diabolo/estimate/square_root.hpp"
#include "diabolo/state.hpp"

namespace diabolo {

/// What an estimate is about, as numbers beside a state: position [m], velocity [m/s], spin [rad/s] and, with
/// `kAxle`, two components of the axle's direction [rad]. All else of a state is taken over as it is.
template <bool kAxle>
struct StateChart {
  static constexpr int kSize = kAxle ? 9 : 7;
  static constexpr int kPosition = 0, kVelocity = 3, kSpin = 6, kDirection = 7;

  /// Two unit vectors square to a direction and to each other, as columns; the first one is level.
  static MatrixOf<3, 2> across(const Vector3<double>& axle) {
    const Vector3<double> up = std::abs(axle.z()) < 0.9 ? Vector3<double>::UnitZ() : Vector3<double>::UnitX();
    MatrixOf<3, 2> result;
    result.col(0) = cross<double>(up, axle).normalized();
    result.col(1) = cross<double>(axle, Vector3<double>(result.col(0))).normalized();
    return result;
  }

  /// The state so far from `origin`.
  static State<double> at(const State<double>& origin, const ColumnOf<kSize>& away) {
    State<double> state = origin;
    state.position += away.template segment<3>(kPosition);
    state.velocity += away.template segment<3>(kVelocity);
    state.spin += away[kSpin];
    if constexpr (kAxle)
      state.axis = (origin.axis + across(origin.axis) * away.template tail<2>()).normalized();
    return state;
  }

  /// How far a state is from `origin`; the inverse of at(). Axles are less than a right angle apart.
  static ColumnOf<kSize> from(const State<double>& origin, const State<double>& state) {
    ColumnOf<kSize> away;
    away.template segment<3>(kPosition) = state.position - origin.position;
    away.template segment<3>(kVelocity) = state.velocity - origin.velocity;
    away[kSpin] = state.spin - origin.spin;
    if constexpr (kAxle)
      away.template tail<2>() =
          across(origin.axis).transpose() * state.axis / std::max(0.1, state.axis.dot(origin.axis));
    return away;
  }
};

}  // namespace diabolo
