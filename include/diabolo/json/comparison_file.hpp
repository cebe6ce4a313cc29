// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "diabolo/diagnose/simulator_comparison.hpp"
#include "diabolo/json/fields.hpp"
#include "diabolo/json/records.hpp"

namespace diabolo {

/// The text of a file of the schema diabolo.comparison/1 (docs/your_simulator.md). Throws RecordingError
/// where a text in it is not UTF-8.
inline std::string write_comparison(const SimulatorComparison& comparison) {
  return json_text(record_to_json(comparison), "comparison");
}

}  // namespace diabolo
