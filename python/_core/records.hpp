// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "diabolo/json/fields.hpp"
#include "diabolo/json/records.hpp"

namespace diabolo::python {

namespace py = pybind11;

/// An object as a dictionary.
inline py::dict to_python(const nlohmann::ordered_json& json) {
  return py::module_::import("json").attr("loads")(json.dump());
}

/// A record as a class of its own whose fields are read only. Records that it holds must be bound before.
template <Record T>
py::class_<T> bind_record(py::module_& module) {
  py::class_<T> cls(module, T::kName, T::kDoc);
  T::for_each_field(
      [&](const char* name, auto member, const char* doc) { cls.def_readonly(name, member, doc); });
  cls.def(
      "to_dict", [](const T& record) { return to_python(record_to_json(record)); },
      "The same as its file has it.");
  cls.def(
      "__eq__",
      [](const T& a, const py::object& other) {
        return py::isinstance<T>(other) && record_to_json(a) == record_to_json(other.cast<const T&>());
      },
      py::arg("other"));
  cls.def("__repr__", [](const T& record) {
    std::string text;
    if constexpr (requires { record.sentence; })  // else all of it
      text = record.sentence;
    else
      text = py::repr(to_python(record_to_json(record)));
    return "<" + std::string(T::kName) + ": " + text + ">";
  });
  return cls;
}

}  // namespace diabolo::python
