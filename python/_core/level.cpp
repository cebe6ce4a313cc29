// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "arrays.hpp"
#include "bindings.hpp"
#include "diabolo/model.hpp"
#include "diabolo/plan/level_hands.hpp"
#include "diabolo/plan/level_horizon.hpp"
#include "diabolo/text/shown.hpp"
#include "state.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

template <class Hands>
Hands make_hands(const Model& model, const Array& left, const Array& right, double spin, double lead,
                 double turn, double quickness) {
  Tips<double> home;
  home.left = to_vector3(left, "left");
  home.right = to_vector3(right, "right");
  const LevelHandLimits limits{lead, turn, quickness};
  return {FullPredictor<double>(model.parameters, model.effects), home, spin, Hands::kWeights, limits};
}

void see(LevelHands& hands, const Array& axis, double spin, const py::object& string) {
  const Vector3<double> seen = to_vector3(axis, "axis");
  if (!(std::abs(seen.norm() - 1.0) < 1e-6))
    throw std::invalid_argument("axis: norm " + std::to_string(seen.norm()) + "; expected a unit vector");
  if (!std::isfinite(spin))
    throw std::invalid_argument("spin: " + std::to_string(spin) + " rad/s; expected a finite number");
  hands.see(seen, spin, string_state_from_python(string));
}

template <class Hands>
py::tuple level_tips(const Hands& hands, const Array& left, const Array& right, const Array& left_velocity,
                     const Array& right_velocity) {
  Tips<double> base;
  base.left = to_vector3(left, "left");
  base.right = to_vector3(right, "right");
  base.left_velocity = to_vector3(left_velocity, "left_velocity");
  base.right_velocity = to_vector3(right_velocity, "right_velocity");
  const Tips<double> tips = hands.tips(base);
  return py::make_tuple(from_vector3(tips.left), from_vector3(tips.right), from_vector3(tips.left_velocity),
                        from_vector3(tips.right_velocity));
}

void foresee(LevelHorizon& hands, double time, const State<double>& state, const TipPath<double>& path) {
  check_size("time", time, kLatest, "s");
  check_state("state", state);
  const TipPath<double> plays = path;  // copies: others may change theirs meanwhile
  const State<double> seen = state;
  const py::gil_scoped_release free;
  hands.see(time, seen, plays);
}

/// What all hands that level an axle have.
template <class Hands>
py::class_<Hands> bind_hands(py::module_& module, const char* name, const char* text) {
  const Array zero = from_vector3(Vector3<double>::Zero());
  return py::class_<Hands>(module, name, text)
      .def(
          py::init(&make_hands<Hands>), "model"_a, "left"_a, "right"_a, "spin"_a, py::kw_only(),
          "lead"_a = LevelHandLimits{}.lead, "turn"_a = LevelHandLimits{}.turn,
          "quickness"_a = LevelHandLimits{}.quickness,
          R"(left, right: the hands of the play at rest [m], shape (3,); spin [rad/s], 10 at least. At most `lead`
[rad] are they turned beyond their heading, which itself turns with at most `turn` [rad/s]; they follow with the
rate `quickness` [1/s].)")
      .def("__copy__", [](const Hands& own) { return own; })
      .def(
          "__deepcopy__", [](const Hands& own, const py::dict&) { return own; }, "memo"_a)
      .def(
          "advance",
          [](Hands& hands, double dt) {
            if (!(dt > 0.0) || !std::isfinite(dt))
              throw std::invalid_argument("dt: " + shown(dt) + " s; expected a positive number");
            hands.advance(dt);
          },
          "dt"_a, "Let the hands follow for `dt` [s].")
      .def("tips", &level_tips<Hands>, "left"_a, "right"_a, "left_velocity"_a = zero,
           "right_velocity"_a = zero,
           R"(The motion's tips [m] and their velocities [m/s] as these hands play them now.

Returns left, right, left_velocity, right_velocity, each of the shape (3,).)")
      .def_property_readonly(
          "heading", [](const Hands& hands) { return hands.turned().heading; },
          "Where the player faces, from where the play began to the left [rad].")
      .def_property_readonly(
          "lead", [](const Hands& hands) { return hands.turned().lead; },
          "How far the hands are turned to the left beyond the heading [rad].");
}

}  // namespace

void bind_level(py::module_& module) {
  bind_hands<LevelHands>(module, "LevelHands",
                         R"(Hands that keep the axle of a diabolo level while they play any motion.

They turn the motion towards the axle, and beyond it to tilt it, by the gains of a linear-quadratic regulator on
the model, learnt anew where the spin has changed by a tenth. The model needs a GyroscopicTilt.)")
      .def(
          "see", &see, "axis"_a, "spin"_a, "string_state"_a = "on_string",
          R"(Take in what is seen: the axle, a unit vector, forward, shape (3,), the spin [rad/s], and where the string is.

From a flight until it is taut around the axle again the hands take no lead.)")
      .def_property_readonly(
          "gains",
          [](const LevelHands& hands) {
            const Eigen::Matrix<double, 2, 3, Eigen::RowMajor> gains = hands.gains();
            return Array({2, 3}, gains.data());
          },
          "K of (lead, turn) = -K (tilt, yaw, heading), shape (2, 3).");
  bind_hands<LevelHorizon>(module, "LevelHorizon",
                           R"(Hands that keep the axle level as LevelHands do, by a receding horizon.

Each 0.1 s they plan lead and turn of the next 1.2 s on the model with its free axle, for the motion that they
play meanwhile: pulls, throws, flights and catches to come count, and the place of the diabolo.)")
      .def(
          "see", &foresee, "time"_a, "state"_a, "path"_a,
          R"(Take in the state that is seen at a time [s], with its axis; path: what the hands are to play, not turned.)");
}

}  // namespace diabolo::python
