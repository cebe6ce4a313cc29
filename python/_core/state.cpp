// SPDX-License-Identifier: MIT
#include "state.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "arrays.hpp"
#include "bindings.hpp"
#include "diabolo/text/shown.hpp"
#include "fields.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;
using S = State<double>;

constexpr double kFastestTumble = 1e4;  // [rad/s]
constexpr std::array<const char*, 3> kNames{"on_string", "loose", "flying"};

Vector3<double> to_axis(const Array& array) {
  const Vector3<double> axis = to_vector3(array, "axis");
  if (!(std::abs(axis.norm() - 1.0) < 1e-6))
    throw std::invalid_argument("axis: norm " + std::to_string(axis.norm()) + "; expected a unit vector");
  return axis;
}

Vector3<double> to_tumble(const Array& array, const Vector3<double>& axis) {
  const Vector3<double> tumble = to_vector3(array, "tumble");
  check_tumble(tumble, axis);
  return tumble;
}

double to_spin(double spin) {
  if (!std::isfinite(spin))
    throw std::invalid_argument("spin: " + shown(spin) + " rad/s; expected a finite number");
  return spin;
}

S make_state(const Array& position, const Array& velocity, double spin, const py::object& string_state,
             const Array& axis, const Array& tumble, double turns) {
  S state;
  state.position = to_vector3(position, "position");
  state.velocity = to_vector3(velocity, "velocity");
  state.spin = to_spin(spin);
  state.string_state = string_state_from_python(string_state);
  state.axis = to_axis(axis);
  state.tumble = to_tumble(tumble, state.axis);
  state.turns = to_turns(turns);
  return state;
}

}  // namespace

double to_turns(double turns) {
  if (!(std::abs(turns) <= kMostTurns))
    throw std::invalid_argument("turns: " + shown(turns) + "; expected -10 to 10");
  return turns;
}

void check_tumble(const Vector3<double>& tumble, const Vector3<double>& axis) {
  if (!(tumble.norm() <= kFastestTumble))
    throw std::invalid_argument("tumble: " + shown(tumble.norm()) + " rad/s; expected at most " +
                                shown(kFastestTumble));
  if (!(std::abs(tumble.dot(axis)) <= 1e-6 * (1.0 + tumble.norm())))
    throw std::invalid_argument("tumble: " + shown(tumble.dot(axis)) +
                                " rad/s about the axis; expected an angular velocity square to it");
}

Array state_array(const S& state) {
  Array array(7);
  double* to = std::copy_n(state.position.data(), 3, array.mutable_data());
  to = std::copy_n(state.velocity.data(), 3, to);
  *to = state.spin;
  return array;
}

py::int_ string_state_to_python(StringState state) {
  return py::module_::import("diabolo.enums").attr("StringState")(static_cast<int>(state));
}

StringState string_state_from_python(const py::object& state) {
  if (py::isinstance<py::str>(state)) {
    const auto found = std::ranges::find(kNames, state.cast<std::string>());
    if (found != kNames.end()) return static_cast<StringState>(found - kNames.begin());
  } else if (const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(state.ptr()))) {
    for (std::size_t code = 0; code < kNames.size(); ++code)
      if (index.equal(py::int_(code))) return static_cast<StringState>(code);
  } else {
    PyErr_Clear();
  }
  throw std::invalid_argument("string_state: " + shown_value(state) +
                              "; expected 'on_string', 'loose', 'flying' or a StringState");
}

void bind_state(py::module_& module) {
  const Array zero = from_vector3(Vector3<double>::Zero());
  py::class_<S>(module, "State", R"(State of the diabolo, a point mass that spins.

`position` [m] and `velocity` [m/s] have the shape (3,), world frame: x forward (away from the player), y left,
z up. `spin` [rad/s] is positive when the axle's surface under the string moves towards the right tip. The
string is 'on_string', 'loose' or 'flying', as in diabolo.StringState. `axis`, a unit vector of the shape (3,),
is the axle's direction, which only GyroscopicTilt turns; `tumble` [rad/s], of the shape (3,) and square to it, is
its angular velocity, which only one with an inertia_ratio has. `turns` are those of the string around the axle
beyond `Parameters.wraps`, the pass under it counted: about 0.4 under hands side by side, 1.4 with a turn more,
below zero where the string runs around the axle the other way. A start of n means n whole turns and the pass that
the strands show. Only `Parameters.follow_turns` looks at it and changes it.)")
      .def(py::init(&make_state), "position"_a, "velocity"_a = py::make_tuple(0.0, 0.0, 0.0), "spin"_a = 0.0,
           "string_state"_a = "loose", "axis"_a = py::make_tuple(1.0, 0.0, 0.0),
           "tumble"_a = py::make_tuple(0.0, 0.0, 0.0), "turns"_a = 0.0)
      .def_property(
          "position", [](const S& s) { return from_vector3(s.position); },
          [](S& s, const Array& value) { s.position = to_vector3(value, "position"); },
          "Centre [m], shape (3,).")
      .def_property(
          "velocity", [](const S& s) { return from_vector3(s.velocity); },
          [](S& s, const Array& value) { s.velocity = to_vector3(value, "velocity"); }, "[m/s], shape (3,).")
      .def_property(
          "spin", [](const S& s) { return s.spin; }, [](S& s, double value) { s.spin = to_spin(value); },
          "[rad/s]")
      .def_property(
          "string_state", [](const S& s) { return string_state_to_python(s.string_state); },
          [](S& s, const py::object& value) { s.string_state = string_state_from_python(value); },
          "A StringState; its number or its name may be assigned.")
      .def_property(
          "axis", [](const S& s) { return from_vector3(s.axis); },
          [](S& s, const Array& value) {
            s.axis = to_axis(value);
            s.tumble -= s.axis * s.axis.dot(s.tumble);
          },
          "Direction of the axle, forward: a unit vector, shape (3,). Takes from tumble what is along it.")
      .def_property(
          "tumble", [](const S& s) { return from_vector3(s.tumble); },
          [](S& s, const Array& value) { s.tumble = to_tumble(value, s.axis); },
          "Angular velocity of the axle itself, square to it [rad/s], shape (3,).")
      .def_property(
          "turns", [](const S& s) { return s.turns; }, [](S& s, double value) { s.turns = to_turns(value); },
          "Of the string around the axle beyond Parameters.wraps, the pass under it counted.")
      .def_property_readonly(
          "string_acceleration", [](const S& s) { return from_vector3(s.string_acceleration); },
          "Mean acceleration by the string over the last step [m/s^2], shape (3,).")
      .def("to_array", &state_array, "Position, velocity and spin, shape (7,).")
      .def("__copy__", [](const S& s) { return s; })
      .def(
          "__deepcopy__", [](const S& s, const py::dict&) { return s; }, "memo"_a)
      .def(py::pickle(
          [](const S& s) {
            return py::make_tuple(from_vector3(s.position), from_vector3(s.velocity), s.spin,
                                  static_cast<int>(s.string_state), from_vector3(s.axis),
                                  from_vector3(s.string_acceleration), from_vector3(s.tumble), s.turns);
          },
          [](const py::tuple& t) {
            S state = make_state(t[0].cast<Array>(), t[1].cast<Array>(), t[2].cast<double>(), t[3],
                                 t[4].cast<Array>(), t[6].cast<Array>(), t[7].cast<double>());
            state.string_acceleration = to_vector3(t[5].cast<Array>(), "string_acceleration");
            return state;
          }))
      .def("__repr__", [](const S& s) {
        return py::str("State(position={}, velocity={}, spin={!r}, string_state='{}')")
            .format(from_vector3(s.position).attr("tolist")(), from_vector3(s.velocity).attr("tolist")(),
                    s.spin, kNames[static_cast<std::size_t>(s.string_state)]);
      });
}

}  // namespace diabolo::python
