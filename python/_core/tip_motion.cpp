// SPDX-License-Identifier: MIT
#include "tip_motion.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "diabolo/recording/tip_motion.hpp"

#include "arrays.hpp"
#include "bindings.hpp"
#include "choices.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;
using Motion = SampledTipMotion;

Motion make(const Array& times, const Array& left, const Array& right, const std::string& interpolation) {
  expect_shape(times, "times", {kAny});
  const py::ssize_t size = times.shape(0);
  return {std::vector<double>(times.data(), times.data() + size), to_rows(left, "left", size),
          to_rows(right, "right", size), choice_from_python<Interpolation>(interpolation, "interpolation")};
}

Motion of_recording(const Recording& recording, const std::string& interpolation) {
  const Interpolation between = choice_from_python<Interpolation>(interpolation, "interpolation");
  const TipMotion<double> motion = tip_motion(recording, between);
  const double delay = between == Interpolation::kHeld ? kHeldDelay : 0.0;
  std::vector<double> times;
  std::vector<Vector3<double>> left, right;
  for (const double row_time : row_times(recording)) {
    const double time = row_time + delay;
    if (time < motion.begin() || time > motion.end()) continue;
    const Tips<double> tips = motion.at(time);
    times.push_back(time);
    left.push_back(tips.left);
    right.push_back(tips.right);
  }
  return {std::move(times), std::move(left), std::move(right), between};
}

Array from_rows(const std::vector<Vector3<double>>& rows) {
  Array array({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}});
  double* to = array.mutable_data();
  for (const Vector3<double>& row : rows) to = std::copy_n(row.data(), 3, to);
  return array;
}

/// Left and right tips and their velocities, each of the shape of `times` with a 3 appended.
py::tuple at(const Motion& motion, const Array& times) {
  expect_finite(times, "times");
  std::vector<py::ssize_t> shape = shape_of(times);
  shape.push_back(3);
  Array left(shape), right(shape), left_velocity(shape), right_velocity(shape);
  double *l = left.mutable_data(), *r = right.mutable_data(), *lv = left_velocity.mutable_data(),
         *rv = right_velocity.mutable_data();
  std::size_t hint = 0;
  for (py::ssize_t i = 0; i < times.size(); ++i) {
    const Tips<double> tips = motion.motion.at(times.data()[i], hint);
    l = std::copy_n(tips.left.data(), 3, l);
    r = std::copy_n(tips.right.data(), 3, r);
    lv = std::copy_n(tips.left_velocity.data(), 3, lv);
    rv = std::copy_n(tips.right_velocity.data(), 3, rv);
  }
  return py::make_tuple(left, right, left_velocity, right_velocity);
}

}  // namespace

void bind_tip_motion(py::module_& module) {
  py::class_<Motion, std::shared_ptr<Motion>>(module, "TipMotion",
                                              R"(Motion of the two stick tips, given at increasing instants.

`times` [s] has the shape (M,), `left` and `right` [m] the shape (M, 3), world frame: x forward (away from the
player), y left, z up. Before the first and after the last instant the tips rest. Between two instants they
follow `interpolation`, as in diabolo.Interpolation: 'linear', 'spline' or 'held'.)")
      .def(py::init(&make), "times"_a, "left"_a, "right"_a, "interpolation"_a = "linear")
      .def_property_readonly(
          "times",
          [](const Motion& m) { return Array(static_cast<py::ssize_t>(m.times.size()), m.times.data()); },
          "Instants [s], shape (M,).")
      .def_property_readonly(
          "left", [](const Motion& m) { return from_rows(m.left); }, "Left tips [m], shape (M, 3).")
      .def_property_readonly(
          "right", [](const Motion& m) { return from_rows(m.right); }, "Right tips [m], shape (M, 3).")
      .def_property_readonly("interpolation",
                             [](const Motion& m) { return choice_to_python(m.interpolation); })
      .def_property_readonly(
          "begin", [](const Motion& m) { return m.motion.begin(); }, "First instant [s].")
      .def_property_readonly(
          "end", [](const Motion& m) { return m.motion.end(); }, "Last instant [s].")
      .def("at", &at, "times"_a,
           "Left tips [m], right tips [m], left and right velocities [m/s] at times of any shape (...): four "
           "arrays of the shape (..., 3).")
      .def_static(
          "of_recording", &of_recording, "recording"_a, "interpolation"_a = "spline",
          "Motion of a recording's tips, time zero at its first row; gaps in a tip's track are filled, and "
          "rows before both tips are seen, or after, are left out.")
      .def("__len__", [](const Motion& m) { return m.times.size(); })
      .def("__repr__",
           [](const Motion& m) {
             return py::str("TipMotion({} instants from {:.4g} to {:.4g} s, '{}')")
                 .format(m.times.size(), m.motion.begin(), m.motion.end(),
                         py::object(choice_to_python(m.interpolation).attr("value")));
           })
      .def(py::pickle(
          [](const Motion& m) {
            return py::make_tuple(Array(static_cast<py::ssize_t>(m.times.size()), m.times.data()),
                                  from_rows(m.left), from_rows(m.right),
                                  py::object(choice_to_python(m.interpolation).attr("value")));
          },
          [](const py::tuple& t) {
            return std::make_shared<Motion>(
                make(t[0].cast<Array>(), t[1].cast<Array>(), t[2].cast<Array>(), t[3].cast<std::string>()));
          }));
}

}  // namespace diabolo::python
