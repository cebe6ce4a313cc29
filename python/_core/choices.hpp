// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "diabolo/parameters.hpp"
#include "diabolo/sticks.hpp"

namespace diabolo::python {

namespace py = pybind11;

/// The values of an enumeration as Python spells them, in the order of their numbers from 0, and the class of
/// diabolo.enums whose values they are.
template <class Enum>
struct Choices;

template <>
struct Choices<StringLaw> {
  static constexpr const char* kClass = "StringLaw";
  static constexpr std::array<std::string_view, 2> kNames{"pull_velocity", "inextensible"};
};
template <>
struct Choices<Projection> {
  static constexpr const char* kClass = "Projection";
  static constexpr std::array<std::string_view, 2> kNames{"radial", "closest_point"};
};
template <>
struct Choices<NormalRule> {
  static constexpr const char* kClass = "NormalRule";
  static constexpr std::array<std::string_view, 2> kNames{"published", "true"};
};
template <>
struct Choices<FlightRule> {
  static constexpr const char* kClass = "FlightRule";
  static constexpr std::array<std::string_view, 3> kNames{"published", "paper", "slack"};
};
template <>
struct Choices<ThinRule> {
  static constexpr const char* kClass = "ThinRule";
  static constexpr std::array<std::string_view, 2> kNames{"published", "paper"};
};
template <>
struct Choices<SpinRule> {
  static constexpr const char* kClass = "SpinRule";
  static constexpr std::array<std::string_view, 2> kNames{"slip", "length_change"};
};
template <>
struct Choices<Integrator> {
  static constexpr const char* kClass = "Integrator";
  static constexpr std::array<std::string_view, 2> kNames{"euler", "parabolic"};
};
template <>
struct Choices<Interpolation> {
  static constexpr const char* kClass = "Interpolation";
  static constexpr std::array<std::string_view, 3> kNames{"held", "linear", "spline"};
};

/// The member of diabolo.enums, which is a str.
template <class Enum>
py::str choice_to_python(Enum value) {
  const std::string_view name = Choices<Enum>::kNames[static_cast<std::size_t>(value)];
  return py::module_::import("diabolo.enums").attr(Choices<Enum>::kClass)(py::str(name));
}

/// Throws std::invalid_argument that lists the names there are.
template <class Enum>
Enum choice_from_python(std::string_view name, const std::string& field) {
  std::string names;
  for (std::size_t i = 0; i < Choices<Enum>::kNames.size(); ++i) {
    if (Choices<Enum>::kNames[i] == name) return static_cast<Enum>(i);
    names += (i > 0 ? ", '" : "'") + std::string(Choices<Enum>::kNames[i]) + "'";
  }
  throw std::invalid_argument(field + ": '" + std::string(name) + "'; expected one of " + names);
}

}  // namespace diabolo::python
