// SPDX-License-Identifier: MIT
#include "diabolo/model.hpp"

#include <pybind11/stl/filesystem.h>

#include <string>

#include "diabolo/json/model_file.hpp"

#include "bindings.hpp"
#include "choices.hpp"
#include "effects.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

Model make_model(const Parameters<double>& parameters, const std::string& name,
                 const std::string& interpolation, bool own_string_length, bool own_mass,
                 bool own_axle_radius, const py::kwargs& effects) {
  Model model{.name = name,
              .parameters = parameters,
              .effects = {},
              .interpolation = choice_from_python<Interpolation>(interpolation, "interpolation"),
              .own_string_length = own_string_length,
              .own_mass = own_mass,
              .own_axle_radius = own_axle_radius};
  assign_effects(model.effects, effects);
  return model;
}

/// The keyword arguments that make the model again.
py::dict model_dict(const Model& model) {
  py::dict fields("parameters"_a = model.parameters, "name"_a = model.name,
                  "interpolation"_a = choice_to_python(model.interpolation).attr("value"),
                  "own_string_length"_a = model.own_string_length, "own_mass"_a = model.own_mass,
                  "own_axle_radius"_a = model.own_axle_radius);
  for_each_effect(model.effects,
                  [&](const auto& effect) { fields[py::str(std::string(effect.kName))] = py::cast(effect); });
  fields["formula_laws"] = py::cast(model.effects.get<FormulaLaws>());
  fields["residual_force"] = py::cast(model.effects.get<ResidualForce>());
  return fields;
}

Model model_from(const py::dict& fields) { return py::type::of<Model>()(**fields).cast<Model>(); }

}  // namespace

void bind_model(py::module_& module) {
  py::class_<Model> cls(module, "Model", R"(Everything that decides a prediction.

    Model(Parameters(), string_elasticity=StringElasticity.of_stiffness(600.0))

Parameters, and effects beyond the paper by keyword; an effect left out, or None, has the amplitude zero and
changes nothing. Where a Model is to be simulated, Parameters will do.

The rest matters where a recording is to be predicted: `interpolation` says how its tips are read between the
samples, as in diabolo.Interpolation; string length, mass and axle radius are the recording's unless the model
says that its own count.)");
  cls.def(py::init(&make_model), "parameters"_a = Parameters<double>(), py::kw_only(), "name"_a = "custom",
          "interpolation"_a = "spline", "own_string_length"_a = false, "own_mass"_a = false,
          "own_axle_radius"_a = false);
  cls.def_static(
      "published", &published_model,
      "The authors' program with the settings of its evaluation: its own string of 1.46 m, held tips.");
  cls.def_static("paper", &paper_model,
                 "The rules of the paper's text: its own string of 1.45 m, held tips.");
  cls.def_static("consistent", &consistent_model,
                 "Ours: an inextensible string of the recording's length, tips on a smooth path.");
  cls.def_static("load", &load_model, "path"_a, Unlocked(),
                 "Reads a model file (JSON) of the schema diabolo.model/1.");
  cls.def("save", &save_model, "path"_a, Unlocked(), "Writes a model file, whole or not at all.");
  cls.def("to_json", &write_model, "The text of its file.");
  cls.def_static("named", &model_named, "name"_a, "'published', 'paper' or 'consistent'.");
  cls.def_readwrite("name", &Model::name);
  cls.def_readwrite("parameters", &Model::parameters);
  cls.def_property(
      "interpolation", [](const Model& m) { return choice_to_python(m.interpolation); },
      [](Model& m, const std::string& value) {
        m.interpolation = choice_from_python<Interpolation>(value, "interpolation");
      },
      "How the tips of a recording are read between its samples, as in diabolo.Interpolation.");
  cls.def_readwrite("own_string_length", &Model::own_string_length,
                    "Whether parameters.string_length counts, whatever a recording says.");
  cls.def_readwrite("own_mass", &Model::own_mass);
  cls.def_readwrite("own_axle_radius", &Model::own_axle_radius);
  const AllEffects<double> effects;
  for_each_effect(effects, [&](const auto& nominal) {
    using Effect = std::remove_cvref_t<decltype(nominal)>;
    cls.def_property(
        std::string(Effect::kName).c_str(),
        [](Model& m) -> Effect& { return std::get<Effect>(m.effects.members); },
        [](Model& m, const py::object& effect) {
          assign_effect(m.effects, std::string(Effect::kName), effect);
        });
  });
  cls.def_property(
      "formula_laws", [](const Model& m) { return m.effects.get<FormulaLaws>(); },
      [](Model& m, const py::object& laws) { assign_effect(m.effects, "formula_laws", laws); },
      "Laws by formulas (FormulaLaws): a copy; set them anew to change them.");
  cls.def_property(
      "residual_force", [](const Model& m) { return m.effects.get<ResidualForce>(); },
      [](Model& m, const py::object& force) { assign_effect(m.effects, "residual_force", force); },
      "What `fit_residual` learnt (ResidualForce), if anything: a copy; set it anew to change it.");
  cls.def("to_dict", &model_dict, "The keyword arguments that make the model again.");
  cls.def("__repr__",
          [](const Model& m) { return call_text("Model", model_dict(m), model_dict(model_from({}))); });
  bind_copies(cls, &model_dict, &model_from);
}

}  // namespace diabolo::python
