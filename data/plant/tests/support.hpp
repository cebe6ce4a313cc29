// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "../../../tests/catch.hpp"
#include "strands.hpp"

namespace plant {

/// Hands that keep still for a minute.
inline Motion still_hands(const Vec3& left, const Vec3& right) {
  SticksPose pose;
  pose.tips = {left, right};
  MotionBuilder motion(pose);
  motion.hold(60.0);
  return motion.finish({}, 0);
}

inline const Motion kHands = still_hands({0.0, 0.3, 1.25}, {0.0, -0.3, 1.25});

/// In flight, far above the string.
inline Start thrown(const Vec3& velocity, double spin) {
  Start start;
  start.flying = true;
  start.spin = spin;
  start.position = Vec3(0.0, 0.0, 3.0);
  start.velocity = velocity;
  return start;
}

/// Air that does nothing.
inline AirParameters still_air() {
  AirParameters air;
  air.linear_drag = air.drag = air.magnus = air.windage = 0.0;
  return air;
}

/// The nominal plant without anything that takes or gives energy, between rigid sticks.
inline PlantParameters lossless() {
  PlantParameters parameters;
  parameters.string.damping = 0.0;
  parameters.string.friction = 0.0;
  parameters.sticks.bending_stiffness.reset();
  parameters.air = still_air();
  return parameters;
}

/// Without air and between rigid sticks, but with friction and damping.
inline PlantParameters airless() {
  PlantParameters parameters;
  parameters.sticks.bending_stiffness.reset();
  parameters.air = still_air();
  return parameters;
}

/// The same on a chain; without the string's damping, without that of its waves and kinks.
inline PlantParameters chain(PlantParameters parameters) {
  parameters.structure = Structure::kChain;
  parameters.string.linear_density = 0.0022;
  if (parameters.string.damping == 0.0) {
    parameters.string.bending_damping = 0.0;
    parameters.string.wave_damping = 0.0;
  }
  return parameters;
}

/// Evenly spaced times from 0 to `end` [s].
inline std::vector<double> times_until(double end, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(end * i / count);
  return times;
}

/// A diabolo that hangs `stretch` [m] beyond the string's length, `aside` [m] left of the middle, moving at
/// `velocity`. The axle must be thin.
inline Start on_ellipse(const PlantParameters& parameters, const Motion& motion, double stretch, double aside,
                        const Vec3& velocity) {
  const Pair<Stick> sticks = motion.at(0.0);
  const Vec3 middle = 0.5 * (sticks[0].tip + sticks[1].tip);
  const double major = 0.5 * (parameters.string.length + stretch);
  const double focus = 0.5 * (sticks[1].tip - sticks[0].tip).norm();
  const double minor = std::sqrt(major * major - focus * focus);
  Start start;
  start.spin = 0.0;
  start.position = middle + Vec3(0.0, aside, -minor * std::sqrt(1.0 - aside * aside / (major * major)));
  start.velocity = velocity;
  return start;
}

}  // namespace plant
