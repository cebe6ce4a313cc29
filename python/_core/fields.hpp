// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "diabolo/parameters.hpp"

namespace diabolo::python {

namespace py = pybind11;

/// A value in a message, short: of an array its shape (diabolo.checks.shown).
inline std::string shown_value(py::handle value) {
  return py::module_::import("diabolo.checks").attr("shown")(value).cast<std::string>();
}

/// `value` as a T. Throws py::type_error that names the field where it is something else.
template <class T>
T cast_to(py::handle value, const std::string& name, const char* expected) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    throw py::type_error(name + ": " + shown_value(value) + "; expected " + expected);
  }
}

/// The numeric field of that name of a struct with for_each (Parameters, any effect); null where there is
/// none.
template <class Fields>
double* find_number(Fields& fields, std::string_view name) {
  double* found = nullptr;
  Fields::for_each(fields, [&](const ParameterInfo& info, double& field) {
    if (info.name == name) found = &field;
  });
  return found;
}

/// Adds each numeric field to `into` by its name.
template <class Fields>
void add_numbers(const Fields& fields, py::dict& into) {
  Fields::for_each(fields, [&](const ParameterInfo& info, double value) {
    into[py::str(std::string(info.name))] = value;
  });
}

template <class Fields>
py::list list_of_infos() {
  py::list infos;
  const Fields nominal;
  Fields::for_each(nominal, [&](const ParameterInfo& info, double) { infos.append(info); });
  return infos;
}

/// Makes each numeric field a property; `validate(fields)` throws where a value is out of its range, and then
/// nothing changes.
template <class Fields, class Validate>
void bind_numbers(py::class_<Fields>& cls, const Validate& validate) {
  const Fields nominal;
  Fields::for_each(nominal, [&](const ParameterInfo& info, double) {
    const std::string name(info.name);
    const std::string doc = std::string(info.meaning) + " [" + std::string(info.unit) + "]; within [" +
                            std::string(py::str(py::float_(info.minimum))) + ", " +
                            std::string(py::str(py::float_(info.maximum))) + "]";
    cls.def_property(
        name.c_str(), [name](Fields& fields) { return *find_number(fields, name); },
        [name, validate](Fields& fields, double value) {
          Fields changed = fields;
          *find_number(changed, name) = value;
          validate(changed);
          fields = changed;
        },
        doc.c_str());
  });
}

/// Copies and pickles by the dictionary that `to_dict` gives and `from_dict` takes.
template <class Fields, class ToDict, class FromDict>
void bind_copies(py::class_<Fields>& cls, const ToDict& to_dict, const FromDict& from_dict) {
  cls.def("__copy__", [](const Fields& fields) { return fields; });
  cls.def(
      "__deepcopy__", [](const Fields& fields, const py::dict&) { return fields; }, py::arg("memo"));
  cls.def(
      "__eq__",
      [to_dict](const Fields& a, const py::object& other) {
        return py::isinstance<Fields>(other) && to_dict(a).equal(to_dict(other.cast<const Fields&>()));
      },
      py::arg("other"));
  cls.def(py::pickle(to_dict, from_dict));
}

/// "Name(field=value, ...)" of the fields that differ from `defaults`, so that the text builds the same
/// object again.
inline std::string call_text(const std::string& name, const py::dict& fields, const py::dict& defaults) {
  std::string text;
  for (const auto& [field, value] : fields) {
    if (value.equal(defaults[field])) continue;
    const py::str shown = py::isinstance<py::str>(value) ? py::repr(py::str(value)) : py::repr(value);
    if (!text.empty()) text += ", ";
    text.append(py::str(field)).append("=").append(shown);
  }
  return name + "(" + text + ")";
}

}  // namespace diabolo::python
