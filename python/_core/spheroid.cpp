// SPDX-License-Identifier: MIT
#include "diabolo/string/spheroid.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "arrays.hpp"
#include "bindings.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;
using Surface = Spheroid<double>;

Surface make_spheroid(const Array& left, const Array& right, double string_length) {
  if (!(string_length > 0.0) || !std::isfinite(string_length))
    throw std::invalid_argument("string_length: " + std::to_string(string_length) + " m; must be > 0");
  return {to_vector3(left, "left"), to_vector3(right, "right"), string_length};
}

/// `method` of each point of an array of the shape (..., 3): `components` numbers each, NaN where the point
/// is.
template <int components, class Result>
Array map_points(const Surface& spheroid, Result (Surface::*method)(const Vector3<double>&) const,
                 const Array& points) {
  std::vector<py::ssize_t> shape = shape_of(points);
  if (shape.empty() || shape.back() != 3)
    throw std::invalid_argument("points: shape " + shape_text(shape) + "; expected (..., 3)");
  if constexpr (components == 1) shape.pop_back();
  Array result(shape);
  const double* from = points.data();
  double* to = result.mutable_data();
  for (py::ssize_t i = 0; i < points.size() / 3; ++i, from += 3, to += components) {
    const Vector3<double> point(from[0], from[1], from[2]);
    Eigen::Map<Eigen::Matrix<double, components, 1>> value(to);
    value.setConstant(std::numeric_limits<double>::quiet_NaN());
    if (point.hasNaN()) continue;
    if (!point.allFinite())
      throw std::invalid_argument("points: infinite at row " + std::to_string(i) +
                                  "; expected finite numbers, or NaN in a dropout");
    value << (spheroid.*method)(point);
  }
  return result;
}

}  // namespace

void bind_spheroid(py::module_& module) {
  py::class_<Surface> spheroid(module, "Spheroid",
                               R"(The points that a diabolo reaches when the string is taut.

The stick tips are its foci, the string's length is its major axis: every point on it has the path length
|p - left| + |p - right| == string_length. Methods take points of the shape (..., 3) [m] and give arrays of
the shape (...) or (..., 3); a point with a NaN (a dropout) gives NaN.)");
  spheroid.def(py::init(&make_spheroid), "left"_a, "right"_a, "string_length"_a,
               "Tips, each of the shape (3,) [m], and string length [m].");

  const auto vector = [&spheroid](const char* name, const Vector3<double>& (Surface::*member)() const,
                                  const char* doc) {
    spheroid.def_property_readonly(
        name, [member](const Surface& s) { return from_vector3((s.*member)()); }, doc);
  };
  vector("left", &Surface::left, "Left tip, shape (3,) [m].");
  vector("right", &Surface::right, "Right tip, shape (3,) [m].");
  vector("center", &Surface::center, "Midpoint of the tips, shape (3,) [m].");
  vector("axis", &Surface::axis, "Unit vector from the right tip to the left one, shape (3,).");
  spheroid.def_property_readonly("tip_distance", &Surface::tip_distance, "Distance between the tips [m].")
      .def_property_readonly("string_length", &Surface::string_length, "[m]")
      .def_property_readonly("semi_major", &Surface::semi_major, "Half the string's length [m].")
      .def_property_readonly("semi_minor", &Surface::semi_minor, "Radius across the axis [m].")
      .def_property_readonly("overstretched", &Surface::overstretched,
                             "Whether the tips are farther apart than the string is long.");

  const auto number_of_points = [&spheroid](const char* name,
                                            double (Surface::*method)(const Vector3<double>&) const,
                                            const char* doc) {
    spheroid.def(
        name, [method](const Surface& s, const Array& points) { return map_points<1>(s, method, points); },
        "points"_a, doc);
  };
  number_of_points("path_length", &Surface::path_length, "|p - left| + |p - right| [m].");
  number_of_points("signed_distance", &Surface::signed_distance,
                   "Distance to the surface [m], positive inside (the paper's s).");

  const auto vector_of_points = [&spheroid](const char* name,
                                            Vector3<double> (Surface::*method)(const Vector3<double>&) const,
                                            const char* doc) {
    spheroid.def(
        name, [method](const Surface& s, const Array& points) { return map_points<3>(s, method, points); },
        "points"_a, doc);
  };
  vector_of_points("closest_point", &Surface::closest_point, "The closest points of the surface [m].");
  vector_of_points(
      "radial_point", &Surface::radial_point,
      "Where the rays from the centre leave the spheroid [m] (the published program's projection).");
  vector_of_points("normal", &Surface::normal,
                   "Outward unit normals of the confocal surfaces through the points.");
  vector_of_points("published_normal", &Surface::published_normal,
                   "The unit vectors that the published program takes for the normals.");
  vector_of_points("path_gradient", &Surface::path_gradient,
                   "Derivative of the path length with respect to the point.");

  spheroid.def("__repr__", [](const Surface& s) {
    return py::str("Spheroid(tip_distance={:.4g}, string_length={:.4g})")
        .format(s.tip_distance(), s.string_length());
  });
}

}  // namespace diabolo::python
