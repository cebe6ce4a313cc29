// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <diabolo/state.hpp>
#include <diabolo/sticks.hpp>

namespace diabolo {

inline constexpr double kStringLength = 1.45;  ///< [m]
inline constexpr double kDuration = 1.0;       ///< of a motion [s]
inline constexpr int kChecks = 10;  ///< instants at which positions are compared, the last at the end

/// Both tips with what an integrator of the differential equation needs beside.
struct TipSample : Tips<double> {
  Vector3<double> left_acceleration, right_acceleration;  ///< [m/s^2]
};

/// One tip's smooth motion: start + sum of amplitude * (1 - cos(2 pi frequency t)), at rest at time 0.
struct SmoothMotion {
  struct Term {
    Vector3<double> amplitude;  ///< [m]
    double frequency;           ///< [Hz]
  };
  Vector3<double> start;  ///< [m]
  std::vector<Term> terms;

  /// Position, velocity and acceleration at `time` [s].
  void at(double time, Vector3<double>& position, Vector3<double>& velocity,
          Vector3<double>& acceleration) const {
    position = start;
    velocity = acceleration = Vector3<double>::Zero();
    for (const Term& term : terms) {
      const double w = 2.0 * std::numbers::pi * term.frequency, c = std::cos(w * time);
      position += term.amplitude * (1.0 - c);
      velocity += term.amplitude * (w * std::sin(w * time));
      acceleration += term.amplitude * (w * w * c);
    }
  }
};

/// A second of play; the diabolo begins under the middle of the level tips and swings.
struct Motion {
  SmoothMotion left, right;

  TipSample at(double time) const {
    TipSample tips;
    left.at(time, tips.left, tips.left_velocity, tips.left_acceleration);
    right.at(time, tips.right, tips.right_velocity, tips.right_acceleration);
    return tips;
  }

  State<double> initial_state() const {
    const Vector3<double> half_span = (left.start - right.start) * 0.5;
    const double drop = std::sqrt(0.25 * kStringLength * kStringLength - half_span.squaredNorm());
    State<double> state;
    state.position = (left.start + right.start) * 0.5 - Vector3<double>(0, 0, drop);
    state.velocity = {0.4, 0.3, 0.0};
    state.string_state = StringState::kOnString;
    return state;
  }
};

/// `beat`: the string stays taut. `hop`: the tips are pulled up so briskly that the string goes slack, and
/// snaps taut when the diabolo falls back into it. Throws std::invalid_argument for another name.
inline Motion motion_of_name(const std::string& name) {
  const Vector3<double> left(0.0, 0.4, 1.3), right(0.0, -0.4, 1.3);
  if (name == "beat")
    return {{left, {{{0.05, 0.00, 0.00}, 0.8}, {{0.0, 0.04, 0.05}, 1.5}}},
            {right, {{{-0.03, 0.02, 0.0}, 1.1}, {{0.0, 0.00, 0.06}, 1.2}}}};
  if (name == "hop")
    return {{left, {{{0.03, 0.02, 0.00}, 0.8}, {{0.0, 0.00, 0.13}, 1.6}}},
            {right, {{{-0.02, 0.0, 0.00}, 1.1}, {{0.0, 0.00, 0.12}, 1.6}}}};
  throw std::invalid_argument("motion '" + name + "': must be beat or hop");
}

}  // namespace diabolo
