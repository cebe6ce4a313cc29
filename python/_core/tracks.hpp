// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diabolo/recording/recording.hpp"

#include "arrays.hpp"

namespace diabolo::python {

/// A read-only view of numbers that `owner` keeps.
template <class T>
py::array_t<T> view(const T* data, const std::vector<py::ssize_t>& shape, const py::object& owner) {
  py::array_t<T> array(shape, data, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// Columns of an Eigen matrix are the rows of the array.
template <class Matrix>
py::array_t<double> rows_of(const Matrix& matrix, const py::object& owner) {
  return view(matrix.data(), {matrix.cols(), matrix.rows()}, owner);
}

/// The columns that the rows of an array of the shape (size, 3) are; a row with a NaN is a dropout.
Track to_track(const Array& array, const std::string& name, py::ssize_t size);

/// The same of quaternions x, y, z, w, shape (size, 4); none where there is no array.
OrientationTrack to_orientation(const std::optional<Array>& array, const std::string& name, py::ssize_t size);

}  // namespace diabolo::python
