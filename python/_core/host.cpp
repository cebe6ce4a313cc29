// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "diabolo/hosts/attach.hpp"
#include "diabolo/model.hpp"
#include "diabolo/text/shown.hpp"

#include "state.hpp"
#include "step_tips.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

/// A string with what is kept from step to step.
struct Attached {
  Model model;
  double mass, axial_inertia;
  Vector3<double> gravity;
  std::string motion;
  AttachedString string;
  StringMemory memory;
};

Attached attach(const Model& model, double mass, double axial_inertia, const Array& gravity,
                const std::string& motion) {
  if (motion != "new_velocity" && motion != "constant_force")
    throw std::invalid_argument("motion: '" + motion + "'; expected 'new_velocity' or 'constant_force'");
  const Vector3<double> falls = to_vector3(gravity, "gravity");
  return {model,
          mass,
          axial_inertia,
          falls,
          motion,
          AttachedString(FullPredictor<double>(model.parameters, model.effects), mass, axial_inertia, falls,
                         motion == "new_velocity" ? HostMotion::kNewVelocity : HostMotion::kConstantForce),
          {}};
}

StringWrench step_attached(Attached& attached, const Array& position, const Array& velocity,
                           const Array& axle, double axle_rate, const Array& left0, const Array& right0,
                           const Array& left1, const Array& right1, double dt,
                           const std::optional<std::array<Array, 4>>& velocities,
                           const std::optional<std::array<Array, 4>>& directions, double time) {
  const HostBody body{to_vector3(position, "position"), to_vector3(velocity, "velocity"),
                      to_vector3(axle, "axle"), axle_rate};
  if (!std::isfinite(axle_rate))
    throw std::invalid_argument("axle_rate: " + std::to_string(axle_rate) +
                                " rad/s; expected a finite number");
  if (!is_direction(body.axle) || !(squared_norm(body.axle) > 0.5))
    throw std::invalid_argument("axle: norm " + std::to_string(body.axle.norm()) +
                                "; expected a unit vector");
  const StepTips tips(left0, right0, left1, right1, dt, velocities, directions, time);
  StringMemory memory = attached.memory;
  const StringWrench wrench = attached.string.step(body, tips.begin, tips.end, dt, memory);
  if (!wrench.force.allFinite() || !wrench.torque.allFinite()) {
    PyErr_SetString(PyExc_FloatingPointError, "step: the force is not finite");
    throw py::error_already_set();
  }
  attached.memory = memory;
  return wrench;
}

StringMemory memory_of(const Array& numbers) {
  StringMemory::Numbers n;
  expect_shape(numbers, "memory", {n.size()});
  python::expect_finite(numbers, "memory");
  std::copy_n(numbers.data(), n.size(), n.begin());
  n.back() = to_turns(n.back());
  return StringMemory::of(n);
}

}  // namespace

void bind_host(py::module_& module) {
  py::class_<StringWrench>(module, "StringWrench",
                           "What a host applies over a step, and what the string does.")
      .def_property_readonly(
          "force", [](const StringWrench& w) { return from_vector3(w.force); },
          "On the body's centre, gravity apart [N].")
      .def_property_readonly(
          "torque", [](const StringWrench& w) { return from_vector3(w.torque); }, "On the body [N m].")
      .def_property_readonly(
          "on_left", [](const StringWrench& w) { return from_vector3(w.on_left); }, "On the left tip [N].")
      .def_property_readonly(
          "on_right", [](const StringWrench& w) { return from_vector3(w.on_right); }, "On the right tip [N].")
      .def_readonly("left_tension", &StringWrench::left_tension, "[N]")
      .def_readonly("right_tension", &StringWrench::right_tension, "[N]")
      .def_readonly("slip", &StringWrench::slip, "Of the string over the axle, towards the right tip [m/s].")
      .def_readonly(
          "overstretched", &StringWrench::overstretched,
          "Whether the tips are farther apart than the string is long; it holds the diabolo between "
          "them.");

  py::class_<Attached>(module, "AttachedString",
                       R"(Our string on a body of somebody else's simulator, see docs/hosts.md.

In each step it says which force and torque make a free body move as the predictor does. `mass` [kg] and
`axial_inertia` [kg m^2] are the body's, `gravity` [m/s^2] the host's. `motion` is how the host moves a body:
'new_velocity' by x' = x + v' dt, or 'constant_force' by x' = x + v dt + a dt^2 / 2. Raises ValueError.)")
      .def(py::init(&attach), "model"_a, "mass"_a, "axial_inertia"_a,
           "gravity"_a = from_vector3({0.0, 0.0, -kStandardGravity}), "motion"_a = "new_velocity")
      .def_property(
          "memory", [](const Attached& a) { return a.memory.numbers(); },
          [](Attached& a, const Array& numbers) { a.memory = memory_of(numbers); },
          R"(What is kept from step to step, eight numbers: save and restore it with the host's state. The last two are
the string's state, 0 on the string, 1 loose (a new one's), 2 in flight, and State.turns.)")
      .def(py::pickle(
          [](const Attached& a) {
            return py::make_tuple(a.model, a.mass, a.axial_inertia, from_vector3(a.gravity), a.motion,
                                  a.memory.numbers());
          },
          [](const py::tuple& t) {
            Attached a = attach(t[0].cast<Model>(), t[1].cast<double>(), t[2].cast<double>(),
                                t[3].cast<Array>(), t[4].cast<std::string>());
            a.memory = memory_of(t[5].cast<Array>());
            return a;
          }))
      .def("__copy__", [](const Attached& a) { return a; })
      .def(
          "__deepcopy__", [](const Attached& a, const py::dict&) { return a; }, "memo"_a)
      .def("step", &step_attached, "position"_a, "velocity"_a, "axle"_a, "axle_rate"_a, "left0"_a, "right0"_a,
           "left1"_a, "right1"_a, "dt"_a, "velocities"_a = py::none(), "directions"_a = py::none(),
           "time"_a = 0.0,
           R"(The wrench for the step of `dt` [s] that begins now; `memory` moves on to the next one.

The body's centre [m], its velocity [m/s], its axle forward, a unit vector, and its angular velocity about
that [rad/s] (the spin is -axle_rate). The rest is as for Predictor.step. Raises FloatingPointError, and leaves
the memory as it was, where the result is not finite.)");
}

}  // namespace diabolo::python
