// SPDX-License-Identifier: MIT
#include "key.hpp"

#include <nlohmann/json.hpp>

#include "coulomb.hpp"

namespace plant {
namespace {

using Json = nlohmann::ordered_json;

/// Where gravity leans to in the recorded frame.
Json tilt(const Scenario& scenario) {
  const Vec3 down = recorded_rotation(scenario.camera) * scenario.plant.gravity;
  const double aside = std::hypot(down.x(), down.y());
  return {{"angle_deg", std::atan2(aside, -down.z()) / kRadiansPerDegree},
          {"azimuth_deg", aside > 0.0 ? std::atan2(down.y(), down.x()) / kRadiansPerDegree : 0.0}};
}

Json stick_flex(const StickParameters& sticks) {
  if (!sticks.bending_stiffness) return nullptr;
  return {{"stiffness", *sticks.bending_stiffness},
          {"tip_mass", sticks.tip_mass},
          {"damping_ratio", sticks.damping_ratio}};
}

/// A chain's Coulomb friction as the capstan coefficient with the same ratio of tensions at a typical wrap.
Json friction(const PlantParameters& plant) {
  const StringParameters& string = plant.string;
  if (plant.structure == Structure::kStrands) {
    return {{"coefficient", string.friction}, {"rise", string.friction_rise}};
  }
  return {{"coefficient", equivalent_capstan(string.friction)}, {"rise", nullptr}};
}

Json tip_offsets(const Pair<Vec3>& offsets) {
  return {{"left_x", offsets[0].x()},  {"left_y", offsets[0].y()},  {"left_z", offsets[0].z()},
          {"right_x", offsets[1].x()}, {"right_y", offsets[1].y()}, {"right_z", offsets[1].z()}};
}

}  // namespace

void write_key(std::ostream& out, const Scenario& scenario) {
  const PlantParameters& plant = scenario.plant;
  const StringParameters& string = plant.string;
  const DiaboloParameters& diabolo = plant.diabolo;
  const AirParameters& air = plant.air;
  const CameraParameters& camera = scenario.camera;
  const Json key = {
      {"schema", "diabolo.plant_key/1"},
      {"seed", scenario.seed},
      {"effects",
       {{"string_elasticity",
         {{"stiffness", string.stiffness / string.length},
          {"damping", string.damping},
          {"stiffening_stretch",
           std::isfinite(string.stiffening_stretch) ? Json(string.stiffening_stretch) : Json(nullptr)}}},
        {"string_friction", friction(plant)},
        {"string_wrap", {{"turns", string.wraps}}},
        {"stick_flex", stick_flex(plant.sticks)},
        {"air_drag_linear", {{"rate", air.linear_drag}}},
        {"air_drag_quadratic", {{"coefficient", air.drag}}},
        {"wind", {{"x", air.wind.x()}, {"y", air.wind.y()}}},
        {"magnus_lift", {{"coefficient", air.magnus}}},
        {"spin_drag", {{"coefficient", air.windage / diabolo.axial_inertia}}},
        {"axle_drag", {{"rate", diabolo.axle_drag}}},
        {"spin_coupling",
         {{"axle_radius", diabolo.groove.radius},
          {"string_radius", string.radius},
          {"axial_inertia", diabolo.axial_inertia}}},
        {"gravity_magnitude", {{"g", plant.gravity.norm()}}},
        {"gravity_tilt", tilt(scenario)},
        {"length_scale", {{"factor", camera.scale}}},
        {"time_offset",
         {{"seconds", 0.5 * (camera.stick_delays[0] + camera.stick_delays[1]) - camera.diabolo_delay}}},
        {"marker_offset",
         {{"radius", std::hypot(camera.centre_offset.y(), camera.centre_offset.z())},
          {"axial", camera.centre_offset.x()}}},
        {"stick_tip_offset", tip_offsets(camera.tip_offsets)},
        {"string_length",
         {{"length", string.length}, {"described", string.length + scenario.string_length_error}}}}},
  };
  out << key.dump(2) << '\n';
}

}  // namespace plant
