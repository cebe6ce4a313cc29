// SPDX-License-Identifier: MIT
#include "parameters.hpp"

#include <algorithm>
#include <string>

#include "arrays.hpp"
#include "bindings.hpp"
#include "choices.hpp"
#include "fields.hpp"

namespace diabolo::python {

namespace {

using P = Parameters<double>;

py::object to_python(bool value) { return py::bool_(value); }
py::object to_python(const Vector3<double>& value) { return from_vector3(value); }
template <class Enum>
py::object to_python(Enum value) {
  return choice_to_python(value);
}

void from_python(py::handle value, const std::string& name, bool& field) {
  py::detail::make_caster<bool> caster;  // without conversion, which takes None for False
  if (!caster.load(value, false))
    throw py::type_error(name + ": " + shown_value(value) + "; expected True or False");
  field = static_cast<bool>(caster);
}
void from_python(py::handle value, const std::string& name, Vector3<double>& field) {
  field = to_vector3(cast_to<Array>(value, name, "an array of the shape (3,)"), name);
}
template <class Enum>
void from_python(py::handle value, const std::string& name, Enum& field) {
  field = choice_from_python<Enum>(cast_to<std::string>(value, name, "a str"), name);
}

py::dict parameters_dict(const P& parameters) {
  py::dict fields;
  add_numbers(parameters, fields);
  P::for_each_rule(parameters, [&]<class Rule>(const RuleInfo& info, const Rule& rule) {
    const py::object value = to_python(rule);
    if constexpr (std::is_same_v<Rule, Vector3<double>>)
      fields[info.name] = value.attr("tolist")();
    else
      fields[info.name] = py::isinstance<py::str>(value) ? value.attr("value") : value;
  });
  return fields;
}

P with_fields(P parameters, const py::kwargs& fields) {
  assign_fields(parameters, fields);
  return parameters;
}

template <std::size_t I>
void bind_rule(py::class_<P>& cls) {
  using Rule = std::remove_reference_t<std::tuple_element_t<I, decltype(P::rules_of(std::declval<P&>()))>>;
  static constexpr RuleInfo kInfo = P::kRules[I];
  const auto set = [](P& p, const py::object& value) {
    P changed = p;
    from_python(value, kInfo.name, std::get<I>(P::rules_of(changed)));
    changed.validate();
    p = changed;
  };
  if constexpr (std::is_enum_v<Rule>) {
    std::string doc = std::string(kInfo.meaning) + ", as in diabolo." + enum_class(Rule{}) + ":";
    for (const std::string_view choice : names_of(Rule{})) doc += " '" + std::string(choice) + "'";
    cls.def_property(
        kInfo.name, [](const P& p) { return choice_to_python(std::get<I>(P::rules_of(p))); },
        [set](P& p, const py::str& value) { set(p, value); }, doc.c_str());
  } else if constexpr (std::is_same_v<Rule, bool>) {
    cls.def_property(
        kInfo.name, [](const P& p) -> bool { return std::get<I>(P::rules_of(p)); },
        [set](P& p, const py::bool_& value) { set(p, value); }, kInfo.meaning);
  } else {
    cls.def_property(
        kInfo.name, [](const P& p) { return from_vector3(std::get<I>(P::rules_of(p))); },
        [set](P& p, const Array& value) { set(p, value); }, kInfo.meaning);
  }
}

/// The call that makes them again, from the preset that they differ from in the fewest fields.
std::string shortest_call(const P& parameters) {
  const py::dict fields = parameters_dict(parameters);
  const auto from = [&](const char* name, const P& preset) {
    return call_text(name, fields, parameters_dict(preset));
  };
  return std::min({from("Parameters", P::consistent()), from("Parameters.paper", P::paper()),
                   from("Parameters.published", P::published())},
                  [](const std::string& a, const std::string& b) {
                    return std::ranges::count(a, '=') < std::ranges::count(b, '=');
                  });
}

void bind_rules(py::class_<P>& cls) {
  [&]<std::size_t... I>(std::index_sequence<I...>) { (bind_rule<I>(cls), ...); }
  (std::make_index_sequence<P::kRules.size()>{});
}

}  // namespace

void assign_fields(Parameters<double>& parameters, const py::kwargs& fields) {
  for (const auto& [key, value] : fields) {
    const std::string name = py::str(key);
    double* const number = find_number(parameters, name);
    if (number) *number = cast_to<double>(value, name, "a number");
    bool found = number != nullptr;
    P::for_each_rule(parameters, [&](const RuleInfo& info, auto& rule) {
      if (name != info.name) return;
      from_python(value, name, rule);
      found = true;
    });
    if (!found) throw py::type_error("Parameters has no field '" + name + "'");
  }
  parameters.validate();
}

void bind_parameters(py::module_& module) {
  py::class_<ParameterInfo>(module, "ParameterInfo", "Name, unit and range of a numeric parameter.")
      .def_readonly("name", &ParameterInfo::name)
      .def_readonly("unit", &ParameterInfo::unit)
      .def_readonly("minimum", &ParameterInfo::minimum)
      .def_readonly("maximum", &ParameterInfo::maximum)
      .def_readonly("meaning", &ParameterInfo::meaning)
      .def("__repr__", [](const ParameterInfo& info) {
        return py::str("<{} [{}] within [{}, {}]: {}>")
            .format(info.name, info.unit, info.minimum, info.maximum, info.meaning);
      });

  py::class_<P> cls(module, "Parameters", R"(Everything that the predictor can be told.

    Parameters(string_length=1.4)              # ours: an inextensible string, the default
    Parameters.paper(axle_radius=0.007)        # the rules of the paper's text
    Parameters.published()                     # the authors' program

Keywords set fields; a rule is chosen by a member of its enumeration or by its name. A value out of its range
is a ValueError that names the field, the value and the range.)");
  cls.def(py::init([](const py::kwargs& fields) { return with_fields(P::consistent(), fields); }));
  cls.def_static(
      "consistent", [](const py::kwargs& fields) { return with_fields(P::consistent(), fields); },
      "Inextensible massless string without friction; results converge as the step goes to zero.");
  cls.def_static(
      "paper", [](const py::kwargs& fields) { return with_fields(P::paper(), fields); },
      "The rules of the paper's text with its errata corrected.");
  cls.def_static(
      "published", [](const py::kwargs& fields) { return with_fields(P::published(), fields); },
      "The authors' program, rule by rule, with the settings of its evaluation.");
  cls.def_static("fields", &list_of_infos<P>, "Name, unit and range of every numeric field (ParameterInfo).");
  bind_numbers(cls, [](const P& p) { p.validate(); });
  bind_rules(cls);
  cls.def(
      "replace", [](const P& p, const py::kwargs& fields) { return with_fields(p, fields); },
      "A copy with other values in the given fields.");
  cls.def("to_dict", &parameters_dict, "All fields by name; Parameters(**fields) builds them again.");
  cls.def("__repr__", &shortest_call);
  bind_copies(cls, &parameters_dict,
              [](const py::dict& fields) { return with_fields(P::consistent(), py::kwargs(fields)); });
}

}  // namespace diabolo::python
