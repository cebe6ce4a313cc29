// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "diabolo/json/fields.hpp"
#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// Reads {"mass": kg, "diameter": m, "length": m, "axle_radius": m}.
inline DiaboloProperties properties_from_json(const JsonFields& fields) {
  return {fields.positive("mass"), fields.positive("diameter"), fields.positive("length"),
          fields.positive("axle_radius")};
}

/// {"mass": kg, "diameter": m, "length": m, "axle_radius": m}
inline nlohmann::ordered_json to_json(const DiaboloProperties& properties) {
  return {{"mass", properties.mass},
          {"diameter", properties.diameter},
          {"length", properties.length},
          {"axle_radius", properties.axle_radius}};
}

}  // namespace diabolo
