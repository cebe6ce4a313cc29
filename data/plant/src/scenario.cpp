// SPDX-License-Identifier: MIT
#include "scenario.hpp"

#include <fstream>
#include <initializer_list>

#include "ideal.hpp"
#include "player.hpp"

namespace plant {
namespace {

/// Refuses fields for which a chain has no law.
void refuse_in_chain(const Fields& fields, Structure structure, std::initializer_list<const char*> keys) {
  if (structure != Structure::kChain) return;
  for (const char* key : keys) {
    if (fields.has(key)) fields.fail(key, fields.text(key), "no such field for a chain");
  }
}

DiaboloParameters read_diabolo(Fields fields, DiaboloParameters diabolo, Structure structure) {
  refuse_in_chain(fields, structure, {"bearing_torque", "tension_drag", "flank_friction", "flank_radius"});
  fields.read("mass", diabolo.mass, {0.01, 5.0});
  fields.read("diameter", diabolo.diameter, {0.02, 0.5});
  fields.read("length", diabolo.length, {0.03, 0.5});
  fields.read("axial_inertia", diabolo.axial_inertia, {1e-6, 0.1});
  fields.read("inertia_ratio", diabolo.inertia_ratio, {0.5, 5.0});
  fields.read("axle_radius", diabolo.groove.radius, {0.0, 0.05});
  fields.read("groove_radius", diabolo.groove.profile_radius, {0.0, 0.05});
  fields.read("groove_half_width", diabolo.groove.half_width, {0.0, 0.05});
  fields.read("groove_offset", diabolo.groove.offset, {-0.02, 0.02});
  fields.read("bearing_torque", diabolo.bearing_torque, {0.0, 1.0});
  fields.read("axle_drag", diabolo.axle_drag, {0.0, 1000.0});
  fields.read("tension_drag", diabolo.tension_drag, {0.0, 100.0});
  fields.read("flank_friction", diabolo.flank_friction, {0.0, 2.0});
  fields.read("flank_radius", diabolo.flank_radius, {0.001, 0.1});
  fields.finish();
  return diabolo;
}

StringParameters read_string(Fields fields, StringParameters string, Structure structure) {
  const bool is_chain = structure == Structure::kChain;
  refuse_in_chain(fields, structure,
                  {"creep", "stiffening_stretch", "friction_rise", "stribeck_speed", "lay", "wraps"});
  fields.read("length", string.length, {0.2, 5.0});
  fields.read("creep", string.creep, {0.0, 0.1});
  fields.read("radius", string.radius, {0.0, 0.01});
  fields.read("stiffness", string.stiffness, {10.0, 1e6});
  fields.read("stiffening_stretch", string.stiffening_stretch, {1e-4, 1e6});
  fields.read("damping", string.damping, {0.0, 1e4});
  fields.read("friction", string.friction, {0.0, is_chain ? 0.9 : 1.0});
  fields.read("friction_rise", string.friction_rise, {0.0, 1.0});
  fields.read("stribeck_speed", string.stribeck_speed, {1e-4, 10.0});
  fields.read("lay", string.lay, {-1.0, 1.0});
  fields.read("slip_scale", string.slip_scale, {1e-4, 1.0});
  fields.read("linear_density", string.linear_density, {is_chain ? 1e-4 : 0.0, 0.05});
  if (is_chain) {
    fields.read("segments", string.segments, {10.0, 100.0});
    fields.read("bending_damping", string.bending_damping, {0.0, 1e-4});
    fields.read("wave_damping", string.wave_damping, {0.0, 100.0});
  }
  fields.read("wraps", string.wraps, {0.0, 5.0});
  fields.finish();
  return string;
}

StickParameters read_sticks(Fields fields, StickParameters sticks) {
  fields.read("bending_stiffness", sticks.bending_stiffness, {10.0, 1e5});
  fields.read("tip_mass", sticks.tip_mass, {1e-3, 0.5});
  fields.read("damping_ratio", sticks.damping_ratio, {0.0, 2.0});
  fields.finish();
  return sticks;
}

AirParameters read_air(Fields fields, AirParameters air) {
  fields.read("linear_drag", air.linear_drag, {0.0, 10.0});
  fields.read("drag", air.drag, {0.0, 1.0});
  fields.read("drag_power", air.drag_power, {1.0, 4.0});
  fields.read("constant_drag", air.constant_drag, {0.0, 100.0});
  fields.read("magnus", air.magnus, {-0.1, 0.1});
  fields.read("wind", air.wind);
  fields.read("tip_wake", air.tip_wake, {-100.0, 100.0});
  fields.read("pull", air.pull, {-100.0, 100.0});
  fields.read("pull_centre", air.pull_centre);
  fields.read("gust", air.gust);
  fields.read("spin_gust", air.spin_gust, {-1000.0, 1000.0});
  fields.read("gust_frequency", air.gust_frequency, {0.0, 100.0});
  fields.read("gust_phase", air.gust_phase, {-10.0, 10.0});
  fields.read("windage", air.windage, {0.0, 1e-5});
  fields.read("windage_power", air.windage_power, {0.5, 4.0});
  fields.finish();
  return air;
}

Start read_start(Fields fields) {
  Start start;
  fields.read("spin", start.spin, {-1000.0, 1000.0});
  fields.read_degrees("yaw_deg", start.yaw, {-180.0, 180.0});
  fields.read_degrees("pitch_deg", start.pitch, {-89.0, 89.0});
  if (fields.has("position")) start.position = fields.vector("position");
  fields.read("velocity", start.velocity);
  fields.read("flying", start.flying);
  if (!start.position && (start.flying || fields.has("velocity"))) {
    fields.fail("position", "nothing", "three numbers, as the start is flying or has a velocity");
  }
  fields.finish();
  return start;
}

Player read_player(Fields fields) {
  Player player;
  fields.read("catches", player.catches);
  fields.read("steers", player.steers);
  fields.finish();
  return player;
}

CameraParameters read_camera(Fields fields, CameraParameters camera) {
  fields.read("rate", camera.rate, {1.0, 10000.0});
  fields.read("white_noise", camera.white_noise, {0.0, 0.1});
  fields.read("drift_noise", camera.drift_noise, {0.0, 0.1});
  fields.read("drift_time", camera.drift_time, {1e-4, 100.0});
  fields.read("attitude_noise", camera.attitude_noise, {0.0, 0.5});
  fields.read("dropout_share", camera.dropout_share, {0.0, 0.5});
  fields.read("shortest_dropout", camera.shortest_dropout, {1.0, 10000.0});
  fields.read("longest_dropout", camera.longest_dropout,
              {static_cast<double>(camera.shortest_dropout), 10000.0});
  fields.read("scale", camera.scale, {0.5, 2.0});
  fields.read_degrees("tilt_deg", camera.tilt, {0.0, 90.0});
  fields.read_degrees("tilt_azimuth_deg", camera.tilt_azimuth, {-360.0, 360.0});
  fields.read("left_tip_offset", camera.tip_offsets[0]);
  fields.read("right_tip_offset", camera.tip_offsets[1]);
  fields.read("centre_offset", camera.centre_offset);
  fields.read("left_delay", camera.stick_delays[0], {-1.0, 1.0});
  fields.read("right_delay", camera.stick_delays[1], {-1.0, 1.0});
  fields.read("diabolo_delay", camera.diabolo_delay, {-1.0, 1.0});
  fields.read("stick_orientation", camera.stick_orientation);
  fields.finish();
  return camera;
}

}  // namespace

Scenario scenario_from_json(const Fields::Json& json, std::optional<std::uint64_t> seed) {
  Fields fields(json, "");
  std::string schema;
  fields.read("schema", schema);
  if (schema != "diabolo.scenario/1") fields.fail("schema", '"' + schema + '"', "\"diabolo.scenario/1\"");
  std::string about;
  fields.read("about", about);

  std::string structure_name = "strands";
  fields.read("structure", structure_name);
  const Structure structure = structure_name == "chain" ? Structure::kChain : Structure::kStrands;
  if (structure == Structure::kStrands && structure_name != "strands") {
    fields.fail("structure", '"' + structure_name + '"', "\"strands\" or \"chain\"");
  }
  std::string base = "nominal";
  fields.read("base", base);
  const bool ideal = base == "ideal";
  if (!ideal && base != "nominal") fields.fail("base", '"' + base + '"', "\"nominal\" or \"ideal\"");
  PlantParameters plant = ideal ? ideal_plant(structure) : nominal_plant(structure);
  plant.diabolo = read_diabolo(fields.object("diabolo"), plant.diabolo, structure);
  plant.string = read_string(fields.object("string"), plant.string, structure);
  plant.sticks = read_sticks(fields.object("sticks"), plant.sticks);
  plant.air = read_air(fields.object("air"), plant.air);
  fields.read("gravity", plant.gravity);
  fields.read("steps_per_second", plant.steps_per_second, {1000.0, 10e6});

  std::uint64_t written_seed = 0;
  fields.read("seed", written_seed);
  const std::uint64_t used_seed = seed.value_or(written_seed);

  Scenario scenario{plant, motion_from_fields(fields.object("motion"), used_seed),
                    read_start(fields.object("start")),
                    read_camera(fields.object("camera"), ideal ? ideal_camera() : CameraParameters{})};
  scenario.duration = scenario.motion.duration();
  fields.read("duration", scenario.duration, {0.05, 600.0});
  fields.read("string_length_error", scenario.string_length_error, {-0.5, 0.5});
  scenario.axle_radius_error = ideal ? DiaboloParameters{}.groove.radius - plant.diabolo.groove.radius : 0.0;
  fields.read("axle_radius_error", scenario.axle_radius_error, {-0.05, 0.05});
  fields.read("truth_rate", scenario.truth_rate, {1.0, 1e5});
  scenario.seed = used_seed;
  const Player player = read_player(fields.object("player"));
  fields.finish();
  scenario.motion = played_by(player, plant, scenario.start, scenario.motion, scenario.duration);
  return scenario;
}

Scenario load_scenario(const std::filesystem::path& file, std::optional<std::uint64_t> seed) {
  std::ifstream in(file);
  if (!in) throw ScenarioError(file.string() + ": cannot be read");
  try {
    return scenario_from_json(Fields::Json::parse(in), seed);
  } catch (const nlohmann::json::exception& error) {
    throw ScenarioError(file.string() + ": not JSON: " + error.what());
  } catch (const std::logic_error& error) {
    throw ScenarioError(file.string() + ": " + error.what());
  }
}

}  // namespace plant
