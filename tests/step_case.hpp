// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/string/taut_string.hpp"

/// A StringStep together with everything that it refers to.
struct StepCase {
  using Vector = diabolo::Vector3<double>;

  Vector position = Vector::Zero(), velocity = Vector::Zero();
  Vector acceleration{0.0, 0.0, -diabolo::kStandardGravity};
  diabolo::Tips<double> begin, end;
  double dt = 1e-3, length = 1.45;
  Vector guess = Vector::Zero();
  double compliance = 0.0, damping_time = 0.0;
  diabolo::PlaneProjector<double> plane;

  diabolo::StringStep<double> step() const {
    return {position, velocity, acceleration, begin, end, dt, length, guess, compliance, damping_time, plane};
  }

  /// Both tips at rest.
  void rest(const Vector& left, const Vector& right) {
    begin = {left, right, Vector::Zero(), Vector::Zero()};
    end = begin;
  }

  /// Both tips from here on with constant velocities.
  void move(const diabolo::Tips<double>& from) {
    begin = end = from;
    end.left += from.left_velocity * dt;
    end.right += from.right_velocity * dt;
  }

  /// Path length of a position with the tips at the end.
  double path(const Vector& p) const { return (p - end.left).norm() + (p - end.right).norm(); }
};
