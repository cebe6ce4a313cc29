// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>

#include "diabolo/math/vector3.hpp"
#include "diabolo/sticks.hpp"

// How a tip moves over the next step, from what a host shows of it step by step.
namespace diabolo {

/// A tip over one step: where it is at its beginning and its end [m], and how it moves there [m/s].
struct TipStep {
  Vector3<double> begin, end, begin_velocity, end_velocity;
  Vector3<double> direction = Vector3<double>::Zero();  ///< of the stick, see Tips
};

/// What is kept of a tip from step to step; nothing before the first one.
struct TipMemory {
  Vector3<double> place = Vector3<double>::Zero();  ///< where it was seen last [m]
  Vector3<double> rate =
      Vector3<double>::Zero();  ///< its velocity then, or its mean over the last step [m/s]
};

/// A tip that the host puts where it is to be after the step, which takes `dt` [s]. Its velocities are
/// differences of its places; in the first step it rests.
inline TipStep placed_tip(const Vector3<double>& place, double dt, std::optional<TipMemory>& memory) {
  const Vector3<double> from = memory ? memory->place : place, mean = (place - from) / dt,
                        last = memory ? memory->rate : mean;
  memory = TipMemory{place, mean};
  return {from, place, 0.5 * (last + mean), 1.5 * mean - 0.5 * last};
}

/// A tip that the host moves by its own dynamics: over the step its velocity changes as over the last one.
inline TipStep moving_tip(const Vector3<double>& place, const Vector3<double>& velocity, double dt,
                          std::optional<TipMemory>& memory) {
  const Vector3<double> before = memory ? memory->rate : velocity, after = 2.0 * velocity - before;
  memory = TipMemory{place, velocity};
  return {place, place + after * dt, velocity, after};
}

/// Both at the beginning and at the end of a step of `dt` that begins at `time` [s].
inline std::pair<Tips<double>, Tips<double>> tips_of_step(const TipStep& left, const TipStep& right,
                                                          double time, double dt) {
  return {{left.begin, right.begin, left.begin_velocity, right.begin_velocity, left.direction,
           right.direction, time},
          {left.end, right.end, left.end_velocity, right.end_velocity, left.direction, right.direction,
           time + dt}};
}

}  // namespace diabolo
