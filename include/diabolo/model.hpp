// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

#include "diabolo/full_predictor.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Everything that decides a prediction, apart from the recording that it is made for.
struct Model {
  std::string name;
  Parameters<double> parameters;
  AllEffects<double> effects;
  Interpolation interpolation = Interpolation::kSpline;  ///< how the stick tips are read between samples
  /// Whether the model's own value counts whatever a recording says of its string and its diabolo.
  bool own_string_length = false, own_mass = false, own_axle_radius = false;
};

/// The authors' program with the settings of its evaluation: its own string of 1.46 m and held tips.
inline Model published_model() {
  return {.name = "published",
          .parameters = Parameters<double>::published(),
          .effects = {},
          .interpolation = Interpolation::kHeld,
          .own_string_length = true,
          .own_mass = false,
          .own_axle_radius = true};
}

/// The rules of the paper's text: its own string of 1.45 m and held tips.
inline Model paper_model() {
  Model model = published_model();
  model.name = "paper";
  model.parameters = Parameters<double>::paper();
  return model;
}

/// The library's default: an inextensible string of the recording's length, tips on a smooth path.
inline Model consistent_model() {
  Model model;
  model.name = "consistent";
  model.parameters = Parameters<double>::consistent();
  return model;
}

/// The model of the given name: published, paper or consistent. Throws std::invalid_argument.
inline Model model_named(const std::string& name) {
  if (name == "published") return published_model();
  if (name == "paper") return paper_model();
  if (name == "consistent") return consistent_model();
  throw std::invalid_argument("model " + shown(name) + "; expected published, paper or consistent");
}

/// The model's parameters with what it leaves to the recording.
inline Parameters<double> parameters_for(const Model& model, const Recording& recording) {
  Parameters<double> result = model.parameters;
  if (!model.own_string_length) result.string_length = recording.string_length;
  if (!model.own_mass) result.mass = recording.properties.mass;
  if (!model.own_axle_radius) result.axle_radius = recording.properties.axle_radius;
  return result;
}

/// The model with the recording's string, mass and axle where it leaves them to it: to simulate, or to plan
/// for, the set-up that was recorded. Throws std::invalid_argument where a parameter is out of its range.
inline Model model_for(Model model, const Recording& recording) {
  model.parameters = parameters_for(model, recording);
  model.parameters.validate();
  return model;
}

/// Predicts the diabolo of the recording by the model. Throws std::invalid_argument where a parameter is out
/// of its range.
inline FullPredictor<double> predictor_for(const Model& model, const Recording& recording) {
  return FullPredictor<double>(parameters_for(model, recording), model.effects);
}

/// Whether the model's spin has a sign; the published rules count turns whichever way they go.
inline bool has_signed_spin(const Model& model) {
  return model.parameters.string_law == StringLaw::kInextensible;
}

}  // namespace diabolo
