// SPDX-License-Identifier: MIT
#pragma once

#include "camera.hpp"

namespace plant {

/// The plant as it is where a scenario says nothing else. A chain has mass and rigid sticks.
inline PlantParameters nominal_plant(Structure structure) {
  PlantParameters plant;
  plant.structure = structure;
  if (structure == Structure::kChain) {
    plant.string.linear_density = 0.0022;
    plant.sticks.bending_stiffness.reset();
  }
  return plant;
}

/// The plant with every effect neutral: a point of mass on a string that hardly stretches, without friction,
/// air or bending sticks. The string keeps just enough stiffness and damping for the integrator's step; a
/// chain keeps its mass as well.
inline PlantParameters ideal_plant(Structure structure) {
  PlantParameters plant = nominal_plant(structure);
  plant.diabolo.groove = {0.0, 0.0, 0.0};
  plant.string.radius = 0.0;
  plant.string.stiffness = 2e5;
  plant.string.damping = 150.0;
  plant.string.friction = 0.0;
  plant.sticks.bending_stiffness.reset();
  plant.air.drag = 0.0;
  plant.air.magnus = 0.0;
  plant.air.windage = 0.0;
  return plant;
}

/// Cameras that see the truth.
inline CameraParameters ideal_camera() {
  CameraParameters camera;
  camera.white_noise = 0.0;
  camera.drift_noise = 0.0;
  camera.attitude_noise = 0.0;
  camera.dropout_share = 0.0;
  return camera;
}

}  // namespace plant
