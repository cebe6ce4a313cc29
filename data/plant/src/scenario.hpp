// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "camera.hpp"
#include "fields.hpp"

namespace plant {

/// Everything that a recording is made from.
struct Scenario {
  PlantParameters plant;
  Motion motion;  ///< with what the player adds to the planned one
  Start start;
  CameraParameters camera;
  double string_length_error = 0.0;  ///< described minus true string length [m]
  double axle_radius_error = 0.0;    ///< described minus true axle radius [m]
  double duration = 0.0;             ///< [s]
  double truth_rate = 1200.0;        ///< rows per second of the true motion [Hz]
  std::uint64_t seed = 0;            ///< of all random numbers
};

/// Reads a scenario; `seed` takes the place of its own. Throws ScenarioError.
Scenario scenario_from_json(const Fields::Json& json, std::optional<std::uint64_t> seed = std::nullopt);

/// The same from a file, which the message then names too.
Scenario load_scenario(const std::filesystem::path& file, std::optional<std::uint64_t> seed = std::nullopt);

/// Motion of the hands from the scenario's field `motion`. Throws ScenarioError.
Motion motion_from_fields(Fields fields, std::uint64_t seed);

}  // namespace plant
