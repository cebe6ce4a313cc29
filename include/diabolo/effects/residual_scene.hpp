// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "diabolo/effects/residual_law.hpp"
#include "diabolo/math/pairs.hpp"
#include "diabolo/parameters.hpp"
#include "diabolo/state.hpp"
#include "diabolo/sticks.hpp"

namespace diabolo {

/// What a residual force sees of an instant, in the string's frame: right along the tips, forward and level,
/// up square to both. No place and no direction of the world is in it but the vertical.
template <class Scalar>
struct ResidualScene {
  std::array<Vector3<Scalar>, 3> axes;  ///< right, forward, up: unit vectors
  /// By direction, see residual_begin. Of each: 1, velocity, velocity times speed, heading, heading times
  /// pull, mean velocity of the tips; right and forward also place and slip times pull; right slip and spin
  /// times rise; up spin times drift to the right. All of a usual size of one.
  std::array<Scalar, kResidualTerms> terms;
  /// Velocity (3), place beside the middle of the tips (2), mean velocity of the tips (2), spin.
  std::array<Scalar, kResidualInputs> inputs;
};

namespace effects_detail {

inline constexpr double kSlow = 0.05;                      ///< below it a direction counts less [m/s]
inline constexpr double kHardPull = 30.0, kUsual = 10.0;   ///< of the string [m/s^2]
inline constexpr double kUsualSpin = 200.0, kAside = 0.5;  ///< [rad/s], [m]

/// Towards the right tip, forward and level, up.
template <class Scalar>
std::array<Vector3<Scalar>, 3> string_frame(const Tips<Scalar>& tips) {
  const Vector3<Scalar> span = tips.right - tips.left;
  const Scalar level_square = span.x() * span.x() + span.y() * span.y() + Scalar(1e-6);
  const std::array<Scalar, 2> lengths =
                                  square_roots<Scalar>(level_square, level_square + span.z() * span.z()),
                              over = inverses<Scalar>(lengths[0], lengths[1]);
  const Vector3<Scalar> right = span * over[1], forward(-span.y() * over[0], span.x() * over[0], Scalar(0));
  return {right, forward, cross(right, forward)};
}

/// Speed of the axle's surface against the string, towards the right tip, by the mean of both strands [m/s].
template <class Scalar>
Scalar slip(const State<Scalar>& state, const Tips<Scalar>& tips, const Parameters<Scalar>& parameters) {
  const Vector3<Scalar> to_left = tips.left - state.position, to_right = tips.right - state.position;
  const std::array<Scalar, 2> lengths = norms(to_left, to_right);
  const Vector3<Scalar> from_left = state.velocity - tips.left_velocity,
                        from_right = tips.right_velocity - state.velocity;
  const std::array<Scalar, 2> passing =
      quotients<Scalar>(dot(to_left, from_left), dot(to_right, from_right), lengths[0], lengths[1]);
  return state.spin * parameters.axle_radius - (passing[0] + passing[1]) * Scalar(0.5);
}

}  // namespace effects_detail

template <class Scalar>
[[gnu::always_inline]] inline ResidualScene<Scalar> residual_scene(const State<Scalar>& state,
                                                                   const Tips<Scalar>& tips,
                                                                   const Parameters<Scalar>& parameters) {
  using effects_detail::kAside, effects_detail::kHardPull, effects_detail::kSlow, effects_detail::kUsual,
      effects_detail::kUsualSpin, effects_detail::slip, effects_detail::string_frame;
  ResidualScene<Scalar> scene;
  scene.axes = string_frame(tips);
  const auto in_frame = [&](const Vector3<Scalar>& v) {
    return std::array<Scalar, 3>{dot(scene.axes[0], v),
                                 scene.axes[1].x() * v.x() + scene.axes[1].y() * v.y(),  // level
                                 dot(scene.axes[2], v)};
  };
  const Vector3<Scalar> middle = (tips.left + tips.right) * Scalar(0.5),
                        hands = (tips.left_velocity + tips.right_velocity) * Scalar(0.5);
  const std::array<Scalar, 3> v = in_frame(state.velocity), aside = in_frame(state.position - middle),
                              carried = in_frame(hands);
  const Scalar square = squared_norm(state.velocity), slips = slip(state, tips, parameters),
               spin = state.spin * Scalar(1.0 / kUsualSpin);
  const auto [soft_speed, pulled] = square_roots<Scalar>(
      square + Scalar(kSlow * kSlow), squared_norm(state.string_acceleration) + tiny<Scalar>());
  const auto [over_speed, slipping] =  // the sign of the slip, smoothly
      quotients<Scalar>(Scalar(1), slips, soft_speed, absolute(slips) + Scalar(kSlow));
  const Scalar speed = square * over_speed, pull = minimum(pulled, Scalar(kHardPull)) * Scalar(1.0 / kUsual);
  for (std::size_t k = 0; k < 3; ++k) {
    Scalar* const terms = &scene.terms[residual_begin(k)];
    terms[0] = Scalar(1);
    terms[1] = v[k];
    terms[2] = v[k] * speed;
    terms[3] = v[k] * over_speed;
    terms[4] = v[k] * over_speed * pull;
    terms[5] = carried[k];
    if (k == 2) break;
    terms[6] = aside[k] * Scalar(1.0 / kAside);
    terms[7] = slipping * pull;
  }
  scene.terms[8] = slipping;
  scene.terms[9] = spin * v[2];
  scene.terms[kResidualTerms - 1] = spin * v[0];
  scene.inputs = {v[0], v[1], v[2], aside[0], aside[1], carried[0], carried[1], spin};
  return scene;
}

}  // namespace diabolo
