// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include "diabolo/state.hpp"

#include "arrays.hpp"

namespace diabolo::python {

/// The member of diabolo.enums.StringState, which is an int.
pybind11::int_ string_state_to_python(StringState state);

/// From a member of StringState, its number or its name, such as "loose". Throws std::invalid_argument.
StringState string_state_from_python(const pybind11::object& state);

/// Position [m], velocity [m/s] and spin [rad/s], shape (7,).
Array state_array(const State<double>& state);

}  // namespace diabolo::python
