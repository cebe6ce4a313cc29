// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/plan/level_regulator.hpp"

/// A diabolo with a free axle between level hands.
namespace level_scene {

using namespace diabolo;

inline Tips<double> home() {
  Tips<double> tips;
  tips.left = {0.55, 0.3, 1.25};
  tips.right = {0.55, -0.3, 1.25};
  return tips;
}

/// With a groove of that profile [m]; an inertia ratio of zero leaves the nutation out.
inline FullPredictor<double> body(double profile, double inertia_ratio = 1.18) {
  Parameters<double> parameters;
  parameters.spin_coupling = 0.0;
  AllEffects<double> effects;
  effects.get<GyroscopicTilt>().gain = 3.4;
  effects.get<GyroscopicTilt>().inertia_ratio = inertia_ratio;
  effects.get<FiniteAxle>().radius = 0.0073;
  effects.get<FiniteAxle>().follows_axis = 1.0;
  effects.get<Groove>().profile_radius = profile;
  effects.get<Groove>().half_width = 0.005;
  return FullPredictor<double>(parameters, effects);
}

inline State<double> held(const FullPredictor<double>& model, State<double> state, const Tips<double>& tips,
                          double duration) {
  for (int i = 0; i < static_cast<int>(1000 * duration); ++i) model.step(state, tips, tips, 1e-3);
  return state;
}

/// Hangs at rest with its axle at those angles.
inline State<double> resting(const FullPredictor<double>& model, const Tips<double>& tips,
                             const AxleAngles& angles, double spin) {
  AllEffects<double> stiff = model.effects();
  stiff.get<GyroscopicTilt>() = {};
  const FullPredictor<double> still(model.parameters(), stiff);
  State<double> state = hanging_state(tips.left, tips.right, 1.45, spin);
  state.axis = axle_at(angles);
  for (int i = 0; i < 400; ++i) {
    state = held(still, state, tips, 0.01);
    state.velocity.setZero();
  }
  return state;
}

}  // namespace level_scene
