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

/// Throws std::invalid_argument where a tumble [rad/s] is too fast for play or not square to the axis.
void check_tumble(const Vector3<double>& tumble, const Vector3<double>& axis);

/// The given turns of the string; throws std::invalid_argument where they are more than those of play.
double to_turns(double turns);

}  // namespace diabolo::python
