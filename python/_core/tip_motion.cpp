// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>

#include "diabolo/recording/tip_motion.hpp"

#include "arrays.hpp"
#include "bindings.hpp"
#include "choices.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;
using Motion = TipMotion<double>;

Motion make_tip_motion(const Array& times, const Array& left, const Array& right,
                       const std::string& interpolation, const std::optional<Array>& left_directions,
                       const std::optional<Array>& right_directions) {
  expect_shape(times, "times", {kAny});
  const py::ssize_t size = times.shape(0);
  Motion motion(std::vector<double>(times.data(), times.data() + size), to_rows(left, "left", size),
                to_rows(right, "right", size),
                choice_from_python<Interpolation>(interpolation, "interpolation"));
  if (left_directions || right_directions) {
    const auto known = [&](const std::optional<Array>& directions, const char* name) {
      return directions ? to_rows(*directions, name, size)
                        : std::vector<Vector3<double>>(motion.size(), Vector3<double>::Zero());
    };
    motion.point_along(known(left_directions, "left_directions"),
                       known(right_directions, "right_directions"));
  }
  return motion;
}

Array instants(const Motion& motion) {
  return Array(static_cast<py::ssize_t>(motion.size()), motion.times().data());
}

/// One vector of each pose, shape (M, 3).
Array of_poses(const Motion& motion, Vector3<double> Tips<double>::*vector) {
  Array array({static_cast<py::ssize_t>(motion.size()), py::ssize_t{3}});
  double* to = array.mutable_data();
  for (std::size_t i = 0; i < motion.size(); ++i) to = std::copy_n((motion.pose(i).*vector).data(), 3, to);
  return array;
}

/// Some vectors of the tips at times of any shape: arrays of that shape with a 3 appended.
template <std::size_t N>
py::tuple at(const Motion& motion, const Array& times,
             const std::array<Vector3<double> Tips<double>::*, N>& vectors) {
  expect_finite(times, "times");
  std::vector<py::ssize_t> shape = shape_of(times);
  shape.push_back(3);
  py::tuple arrays(N);
  std::array<double*, N> to;
  for (std::size_t k = 0; k < N; ++k) {
    Array array(shape);
    to[k] = array.mutable_data();
    arrays[k] = std::move(array);
  }
  std::size_t hint = 0;
  for (py::ssize_t i = 0; i < times.size(); ++i) {
    const Tips<double> tips = motion.at(times.data()[i], hint);
    for (std::size_t k = 0; k < N; ++k) to[k] = std::copy_n((tips.*vectors[k]).data(), 3, to[k]);
  }
  return arrays;
}

}  // namespace

void bind_tip_motion(py::module_& module) {
  py::class_<Motion, std::shared_ptr<Motion>>(module, "TipMotion",
                                              R"(Motion of the two stick tips, given at increasing instants.

`times` [s] has the shape (M,), `left` and `right` [m] the shape (M, 3), world frame: x forward (away from the
player), y left, z up. Before the first and after the last instant the tips rest. Between two instants they
follow `interpolation`, as in diabolo.Interpolation: 'linear', 'spline' or 'held'. `left_directions` and
`right_directions` are those of the sticks, unit vectors of the shape (M, 3), zero where not known; StickFlex
alone looks at them.)")
      .def(py::init(&make_tip_motion), "times"_a, "left"_a, "right"_a, "interpolation"_a = "linear",
           "left_directions"_a = py::none(), "right_directions"_a = py::none())
      .def_property_readonly("times", &instants, "Instants [s], shape (M,).")
      .def_property_readonly(
          "left", [](const Motion& m) { return of_poses(m, &Tips<double>::left); },
          "Left tips [m], shape (M, 3).")
      .def_property_readonly(
          "right", [](const Motion& m) { return of_poses(m, &Tips<double>::right); },
          "Right tips [m], shape (M, 3).")
      .def_property_readonly(
          "left_directions", [](const Motion& m) { return of_poses(m, &Tips<double>::left_direction); },
          "Of the left stick, shape (M, 3); zero where not known.")
      .def_property_readonly(
          "right_directions", [](const Motion& m) { return of_poses(m, &Tips<double>::right_direction); },
          "Of the right stick, shape (M, 3); zero where not known.")
      .def_property_readonly("interpolation",
                             [](const Motion& m) { return choice_to_python(m.interpolation()); })
      .def_property_readonly("begin", &Motion::begin, "First instant [s].")
      .def_property_readonly("end", &Motion::end, "Last instant [s].")
      .def(
          "at",
          [](const Motion& motion, const Array& times) {
            return at<4>(motion, times,
                         {&Tips<double>::left, &Tips<double>::right, &Tips<double>::left_velocity,
                          &Tips<double>::right_velocity});
          },
          "times"_a,
          "Left tips [m], right tips [m], left and right velocities [m/s] at times of any shape (...): four "
          "arrays of the shape (..., 3).")
      .def(
          "directions_at",
          [](const Motion& motion, const Array& times) {
            return at<2>(motion, times, {&Tips<double>::left_direction, &Tips<double>::right_direction});
          },
          "times"_a,
          "Directions of the left and of the right stick at times of any shape (...): two arrays of the "
          "shape "
          "(..., 3), zero where not known.")
      .def_static(
          "of_recording",
          [](const Recording& recording, const std::string& interpolation) {
            return tip_motion(recording, choice_from_python<Interpolation>(interpolation, "interpolation"));
          },
          "recording"_a, "interpolation"_a = "spline",
          "Motion of a recording's tips and sticks, time zero at its first row; gaps in a tip's track are "
          "filled, and rows before both tips are seen, or after, are left out.")
      .def("__len__", &Motion::size)
      .def("__repr__",
           [](const Motion& m) {
             return py::str("TipMotion({} instants from {:.4g} to {:.4g} s, '{}')")
                 .format(m.size(), m.begin(), m.end(),
                         py::object(choice_to_python(m.interpolation()).attr("value")));
           })
      .def(py::pickle(
          [](const Motion& m) {
            return py::make_tuple(
                instants(m), of_poses(m, &Tips<double>::left), of_poses(m, &Tips<double>::right),
                py::object(choice_to_python(m.interpolation()).attr("value")),
                of_poses(m, &Tips<double>::left_direction), of_poses(m, &Tips<double>::right_direction));
          },
          [](const py::tuple& t) {
            return std::make_shared<Motion>(make_tip_motion(t[0].cast<Array>(), t[1].cast<Array>(),
                                                            t[2].cast<Array>(), t[3].cast<std::string>(),
                                                            t[4].cast<Array>(), t[5].cast<Array>()));
          }));
}

}  // namespace diabolo::python
