// SPDX-License-Identifier: MIT
#include <cctype>

#include "bindings.hpp"
#include "fields.hpp"
#include "models.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

/// "string_elasticity" as "StringElasticity".
std::string class_name(std::string_view name) {
  std::string result;
  bool capital = true;
  for (const char c : name) {
    if (c != '_') result += capital ? static_cast<char>(std::toupper(c)) : c;
    capital = c == '_';
  }
  return result;
}

template <class Effect>
void validate(const Effect& effect) {
  validate_fields<double>(effect, std::string(Effect::kName) + " ");
}

template <class Effect>
py::dict to_dict(const Effect& effect) {
  py::dict fields;
  add_numbers(effect, fields);
  return fields;
}

template <class Effect>
Effect from_dict(const py::dict& fields) {
  Effect effect;
  for (const auto& [key, value] : fields) {
    const std::string name = py::str(key);
    double* const number = find_number(effect, name);
    if (!number) throw py::type_error(class_name(Effect::kName) + " has no field '" + name + "'");
    *number = cast_to<double>(value, name, "a number");
  }
  validate(effect);
  return effect;
}

/// Any effect of the library: its fields are its properties and the keywords of its constructor.
template <class Effect>
py::class_<Effect> bind_effect(py::module_& module, const char* doc) {
  const std::string name = class_name(Effect::kName);
  py::class_<Effect> cls(module, name.c_str(), doc);
  cls.def(py::init([](const py::kwargs& fields) { return from_dict<Effect>(fields); }));
  cls.def_static("fields", &list_of_infos<Effect>, "Name, unit and range of every field (ParameterInfo).");
  bind_numbers(cls, &validate<Effect>);
  cls.def("to_dict", &to_dict<Effect>, "All fields by name.");
  cls.def("__repr__", [name](const Effect& effect) {
    return call_text(name, to_dict(effect), to_dict(Effect{}));
  });
  bind_copies(cls, &to_dict<Effect>, &from_dict<Effect>);
  return cls;
}

/// Sets the effect of that name; false where there is none.
bool assign_effect(AllEffects<double>& effects, const std::string& name, py::handle value) {
  bool found = false;
  for_each_effect(effects, [&](auto& effect) {
    using Effect = std::remove_reference_t<decltype(effect)>;
    if (name != Effect::kName) return;
    const std::string expected = class_name(Effect::kName) + " or None";
    effect = value.is_none() ? Effect{} : cast_to<Effect>(value, name, expected.c_str());
    found = true;
  });
  return found;
}

Model make_model(const Parameters<double>& parameters, const py::kwargs& effects) {
  Model model{parameters, {}};
  for (const auto& [key, value] : effects)
    if (!assign_effect(model.effects, py::str(key), value))
      throw py::type_error("Model has no effect '" + std::string(py::str(key)) + "'");
  return model;
}

py::dict effects_to_dict(const Model& model) {
  py::dict effects;
  for_each_effect(model.effects, [&](const auto& effect) {
    effects[py::str(std::string(effect.kName))] = py::cast(effect);
  });
  return effects;
}

}  // namespace

void bind_effects(py::module_& module) {
  bind_effect<StringElasticity<double>>(module, R"(A string that stretches.

Its tension is stiffness times extension plus damping times the extension's rate, while positive. The
amplitude is the compliance, so that zero, the default, is the rigid string.)")
      .def_static("of_stiffness", &StringElasticity<double>::of_stiffness, "stiffness"_a, "damping"_a = 0.0,
                  "Stiffness [N/m] and damping [N s/m] of the path length.");

  py::class_<Model> model(module, "Model", R"(Parameters, and effects beyond the paper by keyword.

    Model(Parameters(), string_elasticity=StringElasticity.of_stiffness(600.0))

An effect left out, or None, has the amplitude zero and changes nothing. Wherever a Model is expected,
Parameters do.)");
  model.def(py::init(&make_model), "parameters"_a = Parameters<double>());
  model.def_readwrite("parameters", &Model::parameters);
  const AllEffects<double> effects;
  for_each_effect(effects, [&](const auto& nominal) {
    using Effect = std::remove_cvref_t<decltype(nominal)>;
    model.def_property(
        std::string(Effect::kName).c_str(),
        [](Model& m) -> Effect& { return std::get<Effect>(m.effects.members); },
        [](Model& m, const Effect& effect) { std::get<Effect>(m.effects.members) = effect; });
  });
  model.def_property_readonly("effects", &effects_to_dict, "All effects by name.");
  model.def("__repr__", [](const Model& m) {
    std::string text = "Model(" + std::string(py::repr(py::cast(m.parameters)));
    for_each_effect(m.effects, [&](const auto& effect) {
      using Effect = std::remove_cvref_t<decltype(effect)>;
      if (!to_dict(effect).equal(to_dict(Effect{})))
        text += ", " + std::string(Effect::kName) + "=" + std::string(py::repr(py::cast(effect)));
    });
    return text + ")";
  });
  const auto as_tuple = [](const Model& m) { return py::make_tuple(m.parameters, effects_to_dict(m)); };
  model.def("__eq__", [=](const Model& a, const Model& b) { return as_tuple(a).equal(as_tuple(b)); },
            py::is_operator());
  model.def(py::pickle(as_tuple, [](const py::tuple& state) {
    return make_model(state[0].cast<Parameters<double>>(), py::kwargs(state[1].cast<py::dict>()));
  }));
  py::implicitly_convertible<Parameters<double>, Model>();
}

}  // namespace diabolo::python
