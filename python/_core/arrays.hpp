// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "diabolo/math/vector3.hpp"

namespace diabolo::python {

namespace py = pybind11;

/// Any array-like of numbers, read as C-contiguous float64.
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// An extent that is not prescribed, in a shape to expect.
inline constexpr py::ssize_t kAny = -1;

/// A shape as Python prints it, with N for an extent that is not prescribed.
std::string shape_text(const std::vector<py::ssize_t>& shape);
std::vector<py::ssize_t> shape_of(const py::array& array);

/// Throws std::invalid_argument that says what was expected and what was given.
void expect_shape(const py::array& array, const std::string& name, const std::vector<py::ssize_t>& expected);

/// Throws std::invalid_argument where a number is not finite.
void expect_finite(const Array& array, const std::string& name);

/// The vector in an array of the shape (3,), finite.
Vector3<double> to_vector3(const Array& array, const std::string& name);
Array from_vector3(const Vector3<double>& vector);

/// The rows of an array of the shape (N, 3); `size` >= 0 prescribes N.
std::vector<Vector3<double>> to_rows(const Array& array, const std::string& name, py::ssize_t size = kAny);

}  // namespace diabolo::python
