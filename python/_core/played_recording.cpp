// SPDX-License-Identifier: MIT
#include "diabolo/recording/played_recording.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/recording/check.hpp"
#include "diabolo/text/shown.hpp"

#include "arrays.hpp"
#include "bindings.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

Eigen::Matrix3Xd to_columns(const Array& rows, const std::string& name) {
  expect_shape(rows, name, {kAny, 3});
  return Eigen::Map<const Eigen::Matrix3Xd>(rows.data(), 3, rows.shape(0));
}

/// `states`, shape (N, 7): position [m], velocity [m/s] and spin [rad/s]; `axis`, of the axle, shape (N, 3).
Recording make_played(const std::string& name, const Array& time, const Array& left, const Array& right,
                      const Array& states, double rate, const DiaboloProperties& properties,
                      double string_length, const std::optional<Array>& axis, double clock) {
  expect_shape(time, "time", {kAny});
  expect_shape(states, "states", {time.shape(0), 7});
  if (!(std::abs(clock) <= kLargestTime))
    throw std::invalid_argument("clock: " + shown(clock) + " s; expected within 1e9 s");
  if (axis) expect_shape(*axis, "axis", {time.shape(0), 3});
  std::vector<State<double>> played(static_cast<std::size_t>(states.shape(0)));
  for (py::ssize_t i = 0; i < states.shape(0); ++i) {
    const double* numbers = states.data(i, 0);
    State<double>& state = played[static_cast<std::size_t>(i)];
    state.position = {numbers[0], numbers[1], numbers[2]};
    state.velocity = {numbers[3], numbers[4], numbers[5]};
    state.spin = numbers[6];
    if (!axis) continue;
    state.axis = {axis->at(i, 0), axis->at(i, 1), axis->at(i, 2)};
    if (!(std::abs(state.axis.norm() - 1.0) < 1e-6))
      throw std::invalid_argument("axis: norm " + shown(state.axis.norm()) + " in row " + std::to_string(i) +
                                  "; expected unit vectors");
  }
  Recording recording = played_recording(name, Eigen::Map<const Eigen::VectorXd>(time.data(), time.shape(0)),
                                         to_columns(left, "left"), to_columns(right, "right"), played, rate,
                                         properties, string_length);
  recording.clock = clock;
  return recording;
}

/// x, y, z, w.
Array lies(const Array& axis, double turned) {
  Array quaternion(4);
  std::copy_n(played_orientation(to_vector3(axis, "axis"), turned).coeffs().data(), 4,
              quaternion.mutable_data());
  return quaternion;
}

}  // namespace

void bind_played_recording(py::module_& module) {
  module.def("played_properties", &played_properties, "parameters"_a,
             "The diabolo of a model: cups of the paper's red one, the model's mass and axle.");
  module.def(
      "played_orientation", &lies, "axis"_a, "turned"_a,
      "How a diabolo lies that has spun by `turned` [rad]: a quaternion x, y, z, w, body to world, body x "
      "along `axis`, a unit vector.");
  module.def(
      "played_recording", &make_played, "name"_a, "time"_a, "left"_a, "right"_a, "states"_a, "rate"_a,
      "properties"_a, "string_length"_a, "axis"_a = py::none(), "clock"_a = 0.0,
      "A predicted play as a recording: time [s], shape (N,), tips [m], shape (N, 3), and states, position "
      "[m], velocity [m/s] and spin [rad/s], shape (N, 7); its orientations turn by the spin about the "
      "axle's "
      "`axis`, unit vectors, shape (N, 3), by default world x. `clock` is the time of laws at "
      "its begin [s].");
}

}  // namespace diabolo::python
