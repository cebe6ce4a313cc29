// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include "diabolo/parameters.hpp"

namespace diabolo::python {

/// Reads keyword arguments into fields. Throws py::type_error about unknown names and wrong types,
/// std::invalid_argument about values out of their range.
void assign_fields(Parameters<double>& parameters, const pybind11::kwargs& fields);

}  // namespace diabolo::python
