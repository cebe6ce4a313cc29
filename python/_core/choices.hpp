// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>

#include "diabolo/rules.hpp"
#include "diabolo/sticks.hpp"

namespace diabolo::python {

namespace py = pybind11;

// The class of diabolo.enums whose values are the names of a choice (names_of()).
constexpr const char* enum_class(StringLaw) { return "StringLaw"; }
constexpr const char* enum_class(Projection) { return "Projection"; }
constexpr const char* enum_class(NormalRule) { return "NormalRule"; }
constexpr const char* enum_class(FlightRule) { return "FlightRule"; }
constexpr const char* enum_class(ThinRule) { return "ThinRule"; }
constexpr const char* enum_class(SpinRule) { return "SpinRule"; }
constexpr const char* enum_class(Integrator) { return "Integrator"; }
constexpr const char* enum_class(Interpolation) { return "Interpolation"; }

/// The member of diabolo.enums, which is a str.
template <class Enum>
py::str choice_to_python(Enum value) {
  const std::string_view name = names_of(value)[static_cast<std::size_t>(value)];
  return py::module_::import("diabolo.enums").attr(enum_class(value))(py::str(std::string(name)));
}

/// Throws std::invalid_argument that lists the names there are.
template <class Enum>
Enum choice_from_python(std::string_view name, const std::string& field) {
  std::string expected;
  std::size_t i = 0;
  for (const std::string_view known : names_of(Enum{})) {
    if (known == name) return static_cast<Enum>(i);
    expected += (i++ > 0 ? ", '" : "'") + std::string(known) + "'";
  }
  throw std::invalid_argument(field + ": '" + std::string(name) + "'; expected one of " + expected);
}

}  // namespace diabolo::python
