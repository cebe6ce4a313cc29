// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/effects/all.hpp"
#include "diabolo/learn/draw.hpp"

namespace diabolo {

/// Draws a rigid axle that the string turns, and a groove in which it climbs: an inertia ratio of 1 to 1.4, a
/// profile of 2 to 10 mm, a half width of 3 to 8 mm. The gain is the friction's spin_gain, the same number,
/// or without friction that gains spin 3 to 8 1/m. What the model has of these itself stays.
inline void draw_free_axle(AllEffects<double>& effects, Draw& draw) {
  const auto fill = [&draw](double& field, double low, double high) {
    const double drawn = draw.uniform(low, high);
    if (field == 0.0) field = drawn;
  };
  auto& axle = effects.get<GyroscopicTilt>();
  if (axle.gain == 0.0) axle.gain = effects.get<StringFriction>().spin_gain;
  fill(axle.gain, 3.0, 8.0);
  fill(axle.inertia_ratio, 1.0, 1.4);
  auto& groove = effects.get<Groove>();
  fill(groove.profile_radius, 0.002, 0.010);
  fill(groove.half_width, 0.003, 0.008);
}

}  // namespace diabolo
