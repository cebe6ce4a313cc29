// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diabolo/json/fields.hpp"
#include "diabolo/learn/agent.hpp"
#include "diabolo/learn/arena_options.hpp"
#include "diabolo/text/file.hpp"

namespace diabolo {

inline constexpr const char* kAgentSchema = "diabolo.agent/1";
inline constexpr int kMostDecimals = 6;

namespace json_detail {

inline Layer layer_from_json(const JsonFields& fields, double unit) {
  fields.expect_only({"weights", "bias"});
  const nlohmann::json &rows = fields.list("weights"), &bias = fields.list("bias");
  const auto number = [&](const nlohmann::json& value, const char* field) {
    if (!value.is_number()) fields.fail(field, "numbers");
    return static_cast<float>(unit * value.get<double>());
  };
  Layer layer;
  const Eigen::Index outputs = static_cast<Eigen::Index>(rows.size());
  layer.weights.resize(outputs, rows.empty() ? 0 : static_cast<Eigen::Index>(rows.front().size()));
  for (Eigen::Index i = 0; i < outputs; ++i) {
    const nlohmann::json& row = rows[static_cast<std::size_t>(i)];
    if (!row.is_array() || static_cast<Eigen::Index>(row.size()) != layer.weights.cols())
      fields.fail("weights", "rows of the same length");
    for (Eigen::Index j = 0; j < layer.weights.cols(); ++j)
      layer.weights(i, j) = number(row[static_cast<std::size_t>(j)], "weights");
  }
  layer.bias.resize(static_cast<Eigen::Index>(bias.size()));
  for (Eigen::Index i = 0; i < layer.bias.size(); ++i)
    layer.bias[i] = number(bias[static_cast<std::size_t>(i)], "bias");
  return layer;
}

/// The number of the fewest digits that reads as the same float.
inline double shortest(float number) {
  std::array<char, 32> text;
  const char* const end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  double result = 0.0;
  std::from_chars(text.data(), end, result);
  return result;
}

}  // namespace json_detail

/// Reads the text of an agent's file:
///   {"schema": "diabolo.agent/1", "task": "SpinUp", "period": 0.02, "steps": 20,
///    "layers": [{"weights": [[...], ...], "bias": [...]}, ...]}
/// Of several tasks, "task" is a list. With "corrects": true, it corrects plans. With "unit": 0.001, weights
/// and biases are multiples of that. Throws RecordingError with file, field, what was found and what was
/// expected.
inline Agent read_agent(std::string_view text, const std::string& file_name) {
  const nlohmann::json json = parse_json(text, file_name);
  const JsonFields file(json, file_name);
  file.expect_text("schema", kAgentSchema);
  file.expect_only({"schema", "task", "period", "steps", "corrects", "unit", "layers"});
  const double unit = json.contains("unit") ? file.positive("unit") : 1.0;
  std::vector<Layer> layers;
  const nlohmann::json& list = file.list("layers");
  for (std::size_t i = 0; i < list.size(); ++i)
    layers.push_back(json_detail::layer_from_json(
        JsonFields(list[i], file_name, "layers[" + std::to_string(i) + "]."), unit));
  const double steps = file.positive("steps");
  if (!(steps <= 1000.0) || steps != std::floor(steps)) file.fail("steps", "a whole number up to 1000");
  try {
    ArenaOptions options{.tasks = file.names("task"), .period = file.positive("period")};
    options.steps = static_cast<int>(steps);
    options.validate();
    const bool corrects = json.contains("corrects");
    if (corrects && json["corrects"] != true) file.fail("corrects", "true");
    return {options.tasks, options.period, options.steps,
            Policy(std::move(layers), observation_size(seen_too(options.tasks, corrects))), corrects};
  } catch (const RecordingError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw RecordingError(file_name + ": " + error.what());
  }
}

/// Reads an agent's file; see read_agent().
inline Agent load_agent(const std::filesystem::path& path) {
  return read_agent(read_file(path), path.string());
}

/// The text of such a file; reads back as the same agent. With `decimals`, at most kMostDecimals, its numbers
/// are rounded to as many, and the file is smaller.
inline std::string write_agent(const Agent& agent, std::optional<int> decimals = {}) {
  if (decimals && !(*decimals >= 1 && *decimals <= kMostDecimals))
    throw std::invalid_argument("decimals: " + std::to_string(*decimals) + "; expected 1 to " +
                                std::to_string(kMostDecimals));
  const double per = std::pow(10.0, decimals.value_or(0));
  const auto numbers = [&](const auto& row) {
    nlohmann::ordered_json texts = nlohmann::ordered_json::array();
    for (const float number : row) {
      if (decimals)
        texts.push_back(std::llround(per * static_cast<double>(number)));
      else
        texts.push_back(json_detail::shortest(number));
    }
    return texts;
  };
  nlohmann::ordered_json layers = nlohmann::ordered_json::array();
  for (const Layer& layer : agent.policy.layers()) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const auto& row : layer.weights.rowwise()) rows.push_back(numbers(row));
    layers.push_back({{"weights", std::move(rows)}, {"bias", numbers(layer.bias)}});
  }
  nlohmann::ordered_json file{{"schema", kAgentSchema}, {"task", agent.tasks}};
  if (agent.tasks.size() == 1) file["task"] = agent.tasks.front();
  file["period"] = agent.period;
  file["steps"] = agent.steps;
  if (agent.corrects) file["corrects"] = true;
  if (decimals) file["unit"] = 1.0 / per;
  file["layers"] = std::move(layers);
  return file.dump() + "\n";
}

}  // namespace diabolo
