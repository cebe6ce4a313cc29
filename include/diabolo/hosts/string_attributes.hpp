// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tuple>
#include <vector>

#include "diabolo/hosts/attach.hpp"
#include "diabolo/json/model_file.hpp"
#include "diabolo/model.hpp"
#include "diabolo/text/shown.hpp"

// A string by the words of somebody else's model file: an attribute each, such as `model`, `string_length` or
// `air.linear_drag`.
namespace diabolo {

/// Calls visit(key, number) for every number of a model that an attribute may give. Mass and gravity are not
/// among them: they are the host's.
template <class Visit>
void for_each_attribute(Model& model, Visit&& visit) {
  Parameters<double>::for_each(model.parameters, [&](const ParameterInfo& info, double& value) {
    if (info.name != "mass" && info.name != "gravity") visit(std::string(info.name), value);
  });
  const auto visit_effect = [&]<class Effect>(Effect& effect) {
    if constexpr (!Effect::kHasText)
      Effect::for_each(effect, [&](const ParameterInfo& info, double& value) {
        visit(std::string(Effect::kName).append(".").append(info.name), value);
      });
  };
  std::apply([&](auto&... effect) { (visit_effect(effect), ...); }, model.effects.members);
}

/// The names of all attributes: `model` and every number of one.
inline std::vector<std::string> string_attributes() {
  std::vector<std::string> names{"model"};
  Model model = consistent_model();
  for_each_attribute(model, [&](const std::string& key, double&) { names.push_back(key); });
  return names;
}

/// Whether a text is a name that model_named() knows.
inline bool is_preset(const std::string& text) {
  return text == "consistent" || text == "paper" || text == "published";
}

/// The model of the attributes: `attribute(key)` gives the text of one, empty where it is not there. `model`
/// is a model file, its text, or a name as in model_named(); by default `consistent`. A number stands over
/// that of the file. Throws std::invalid_argument or RecordingError with the attribute or the file's field.
template <class Attribute>
Model model_of_attributes(const Attribute& attribute) {
  std::string file = attribute("model");
  file.erase(0, file.find_first_not_of(" \t\r\n"));
  Model model = file.empty()      ? consistent_model()
                : is_preset(file) ? model_named(file)
                : file[0] == '{'  ? read_model(file, "model")
                                  : load_model(file);
  for_each_attribute(model, [&](const std::string& key, double& value) {
    const std::string text = attribute(key);
    if (text.empty()) return;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      throw std::invalid_argument(key + ": " + shown(text) + "; expected a number");
    for (const auto& [name, own] : kRecordedParameters)
      if (key == name) model.*own = true;
  });
  return model;
}

/// The model's string on a host's body; see AttachedString. Throws std::invalid_argument where the host's
/// gravity [m/s^2] is not along -z, or a number is out of its range.
inline AttachedString attach_string(Model model, double mass, double axial_inertia,
                                    const Vector3<double>& gravity, HostMotion motion) {
  if (std::hypot(gravity.x(), gravity.y()) > 1e-9 || gravity.z() > 0.0)
    throw std::invalid_argument("gravity: " + std::to_string(gravity.x()) + " " +
                                std::to_string(gravity.y()) + " " + std::to_string(gravity.z()) +
                                "; expected it along -z");
  model.parameters.mass = mass;
  model.parameters.gravity = -gravity.z();
  return {FullPredictor<double>(model.parameters, model.effects), mass, axial_inertia, gravity, motion};
}

}  // namespace diabolo
