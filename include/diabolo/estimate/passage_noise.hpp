// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "diabolo/estimate/passage.hpp"

namespace diabolo {

/// Deviations at the end of a step: of a passage's points, and what passage_noise() adds.
template <bool kAxle>
using StepDeviations =
    MatrixOf<StateChart<kAxle>::kSize, Passage<kAxle>::Points::kCount + StateChart<kAxle>::kSize + 2>;

/// What a step adds to the deviations of a passage: process noise; and, where the string pulls, how far a
/// string of another length would have all points alike, and how fast one that stretches.
template <bool kAxle>
MatrixOf<StateChart<kAxle>::kSize, StateChart<kAxle>::kSize + 2> passage_noise(const ProcessNoise& noise,
                                                                               const Passage<kAxle>& passage,
                                                                               const Tips<double>& tips,
                                                                               double dt) {
  using Chart = StateChart<kAxle>;
  const double root = std::sqrt(dt);
  MatrixOf<Chart::kSize, Chart::kSize + 2> deviations = MatrixOf<Chart::kSize, Chart::kSize + 2>::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const int position = Chart::kPosition + axis, velocity = Chart::kVelocity + axis;
    deviations(position, position) = noise.acceleration * dt * root / std::sqrt(3.0);
    deviations(velocity, velocity) = noise.acceleration * root;
  }
  deviations(Chart::kSpin, Chart::kSpin) = noise.spin * root;
  if constexpr (kAxle)
    for (int i = Chart::kDirection; i < Chart::kSize; ++i) deviations(i, i) = noise.axle * root;
  if (!(passage.pulled > 0.5)) return deviations;
  const Vector3<double> gradient = StringPath<double>(passage.centre.position, tips).gradient();
  const Vector3<double> way = gradient * (1.0 / std::max(0.1, squared_norm(gradient)));
  deviations.template block<3, 1>(Chart::kPosition, Chart::kSize) = way * noise.string_length;
  deviations.template block<3, 1>(Chart::kVelocity, Chart::kSize + 1) = way * noise.string_rate;
  return deviations;
}

}  // namespace diabolo
