// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "diabolo/learn/hands.hpp"

// Live play: two hands go after two pointers.
namespace diabolo {

/// Rate of the critically damped spring by which a hand goes after its pointer [1/s].
inline constexpr double kFollowRate = 22.0;

/// Most of a hand's speed [m/s] and acceleration [m/s^2]: a plan's for a person, see TipLimits.
inline constexpr double kFastestHand = 4.0, kHardestHand = 60.0;

/// Share of the string's length beyond which hands do not part.
inline constexpr double kWidestHands = 0.995;

/// Moves both hands for a step of `dt` [s] towards where the pointers are [m], as fast as a plan allows a
/// person. What would tear the string, of `string_length` [m], is taken out of their velocities.
inline void follow_pointers(Hands& hands, const Hands::Pair& pointers, double string_length, double dt) {
  const auto bounded = [](const Vector3<double>& vector, double longest) {
    return Vector3<double>(vector * std::min(1.0, longest / std::max(vector.norm(), 1e-9)));
  };
  Hands::Pair& velocity = hands.velocity;
  for (std::size_t side = 0; side < 2; ++side) {
    const Vector3<double> pull = kFollowRate * kFollowRate * (pointers[side] - hands.position[side]) -
                                 2.0 * kFollowRate * velocity[side];
    velocity[side] = bounded(velocity[side] + bounded(pull, kHardestHand) * dt, kFastestHand);
  }
  const Vector3<double> apart = hands.position[0] - hands.position[1] + (velocity[0] - velocity[1]) * dt;
  const Vector3<double> torn = apart - bounded(apart, kWidestHands * string_length);
  velocity[0] -= 0.5 / dt * torn;
  velocity[1] += 0.5 / dt * torn;
  for (std::size_t side = 0; side < 2; ++side) hands.position[side] += velocity[side] * dt;
}

}  // namespace diabolo
