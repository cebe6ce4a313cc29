// SPDX-License-Identifier: MIT
#include "arrays.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace diabolo::python {

std::string shape_text(const std::vector<py::ssize_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i)
    text += (i > 0 ? ", " : "") + (shape[i] == kAny ? std::string("N") : std::to_string(shape[i]));
  return text + (shape.size() == 1 ? ",)" : ")");
}

std::vector<py::ssize_t> shape_of(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

void expect_shape(const py::array& array, const std::string& name, const std::vector<py::ssize_t>& expected) {
  const std::vector<py::ssize_t> given = shape_of(array);
  const auto fits = [](py::ssize_t want, py::ssize_t have) { return want == kAny || want == have; };
  if (!std::ranges::equal(expected, given, fits))
    throw std::invalid_argument(name + ": shape " + shape_text(given) + "; expected " + shape_text(expected));
}

void expect_finite(const Array& array, const std::string& name) {
  const double* const end = array.data() + array.size();
  const double* const bad = std::find_if(array.data(), end, [](double x) { return !std::isfinite(x); });
  if (bad != end)
    throw std::invalid_argument(name + ": " + std::to_string(*bad) + " at index " +
                                std::to_string(bad - array.data()) + " (flattened); expected finite numbers");
}

Vector3<double> to_vector3(const Array& array, const std::string& name) {
  expect_shape(array, name, {3});
  expect_finite(array, name);
  return {array.data()[0], array.data()[1], array.data()[2]};
}

Array from_vector3(const Vector3<double>& vector) {
  Array array(3);
  std::copy_n(vector.data(), 3, array.mutable_data());
  return array;
}

std::vector<Vector3<double>> to_rows(const Array& array, const std::string& name, py::ssize_t size) {
  expect_shape(array, name, {size, 3});
  std::vector<Vector3<double>> rows(static_cast<std::size_t>(array.shape(0)));
  const double* from = array.data();
  for (Vector3<double>& row : rows) {
    row = {from[0], from[1], from[2]};
    from += 3;
  }
  return rows;
}

}  // namespace diabolo::python
