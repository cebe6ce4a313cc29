// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "diabolo/json/fields.hpp"
#include "diabolo/json/records.hpp"

#include "fields.hpp"

namespace diabolo::python {

/// Gives each field of `record` that `fields` has. Throws py::type_error where one is of another type, or is
/// none.
template <Record T>
void assign_fields(T& record, const py::kwargs& fields) {
  std::size_t known = 0;
  T::for_each_field([&]<class Member>(const char* name, Member T::*member, const char*) {
    if (!fields.contains(name)) return;
    record.*member = cast_to<Member>(fields[name], name, "what the field of that name holds");
    ++known;
  });
  if (known < fields.size()) throw py::type_error(std::string(T::kName) + ": a field that it does not have");
}

/// The record as its file has it, as dictionaries and lists.
template <Record T>
py::object to_python(const T& record) {
  return py::module_::import("json").attr("loads")(json_text(record_to_json(record), T::kName));
}

/// "Name(field=value, ...)".
template <Record T>
std::string record_text(const T& record) {
  std::string text;
  T::for_each_field([&](const char* name, auto member, const char*) {
    text += (text.empty() ? "" : ", ") + std::string(name) + "=" +
            std::string(py::repr(py::cast(record.*member)));
  });
  return std::string(T::kName) + "(" + text + ")";
}

/// A record as a class of its own whose fields are read only. Records that it holds must be bound before.
template <Record T>
py::class_<T> bind_record(py::module_& module, std::string (*repr)(const T&) = &record_text<T>) {
  py::class_<T> cls(module, T::kName, T::kDoc);
  cls.def(py::init([](const py::kwargs& fields) {
    T record;
    assign_fields(record, fields);
    return record;
  }));
  T::for_each_field(
      [&](const char* name, auto member, const char* doc) { cls.def_readonly(name, member, doc); });
  cls.def(
      "replaced",
      [](T record, const py::kwargs& fields) {
        assign_fields(record, fields);
        return record;
      },
      "The same with other values of the given fields.");
  cls.def("to_dict", &to_python<T>, "As its file has it.");
  cls.def(
      "__eq__",
      [](const T& a, const py::object& other) {
        return py::isinstance<T>(other) && record_to_json(a) == record_to_json(other.cast<const T&>());
      },
      py::arg("other"));
  cls.def("__repr__", repr);
  return cls;
}

}  // namespace diabolo::python
