// SPDX-License-Identifier: MIT
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "diabolo/model.hpp"
#include "diabolo/strand_tensions.hpp"

#include "effects.hpp"
#include "step_tips.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;
using Simulator = FullPredictor<double>;

Simulator make_predictor(const Model& model, const py::kwargs& given) {
  AllEffects<double> effects = model.effects;
  assign_effects(effects, given);
  return Simulator(model.parameters, effects);
}

/// What happened in a step, and the tensions of the strands.
struct Step {
  StepStatus<double> status;
  std::pair<double, double> tensions;
};

Step step(const Simulator& predictor, State<double>& state, const Array& left0, const Array& right0,
          const Array& left1, const Array& right1, double dt,
          const std::optional<std::array<Array, 4>>& velocities,
          const std::optional<std::array<Array, 4>>& directions, double time) {
  const StepTips tips(left0, right0, left1, right1, dt, velocities, directions, time);
  State<double> next = state;
  const StepStatus<double> status = predictor.step(next, tips.begin, tips.end, dt);
  if (!is_finite(next)) {
    PyErr_SetString(PyExc_FloatingPointError, "step: the state is no longer finite");
    throw py::error_already_set();
  }
  const Step made{status, strand_tensions(predictor, state, next, tips.begin, tips.end, dt)};
  state = next;
  return made;
}

}  // namespace

void bind_predictor(py::module_& module) {
  const auto said = [](bool StepStatus<double>::*field) {
    return [field](const Step& made) { return made.status.*field; };
  };
  py::class_<Step>(module, "StepStatus", "What happened in one step.")
      .def_property_readonly(
          "overstretched", said(&StepStatus<double>::overstretched),
          "The tips are as far apart as the string is long, or farther, whatever the diabolo does.")
      .def_property_readonly("snapped_taut", said(&StepStatus<double>::snapped_taut),
                             "The string came taut within the step.")
      .def_property_readonly("caught", said(&StepStatus<double>::caught),
                             "The string was under a flying diabolo again.")
      .def_property_readonly(
          "turned", [](const Step& made) { return made.status.turned; },
          "1 where a turn of the string came onto the axle within the step, -1 where one went off, else 0;\n"
          "by Parameters.follow_turns.")
      .def_property_readonly(
          "turned_at", [](const Step& made) { return made.status.turned_at; },
          "When it did, after the beginning of the step [s].")
      .def_property_readonly(
          "tensions", [](const Step& made) { return made.tensions; },
          "Mean tensions of the left and the right strand over the step [N], for the mass of the parameters.")
      .def("__repr__", [](const Step& made) {
        return py::str(
                   "StepStatus(overstretched={}, snapped_taut={}, caught={}, tensions=({:.4g}, {:.4g}) N)")
            .format(made.status.overstretched, made.status.snapped_taut, made.status.caught,
                    made.tensions.first, made.tensions.second);
      });

  py::class_<Simulator>(module, "Predictor", R"(Predicts the diabolo from the motion of the stick tips.

    predictor = Predictor(Parameters())
    predictor = Predictor(Parameters(), string_elasticity=StringElasticity.of_stiffness(600.0))
    predictor.step(state, left0, right0, left1, right1, dt=1e-3)

It holds nothing but checked constants; the state is yours. For many steps, or many states, use rollout().)")
      .def(py::init([](const Parameters<double>& parameters, const py::kwargs& effects) {
             return make_predictor({.name = {}, .parameters = parameters, .effects = {}}, effects);
           }),
           "parameters"_a)
      .def(py::init(&make_predictor), "model"_a)
      .def_property_readonly(
          "parameters", [](const Simulator& p) { return p.parameters(); }, "A copy.")
      .def(py::pickle(
          [](const Simulator& p) {
            return py::make_tuple(Model{.name = {}, .parameters = p.parameters(), .effects = p.effects()});
          },
          [](const py::tuple& t) {
            const Model model = t[0].cast<Model>();
            return Simulator(model.parameters, model.effects);
          }))
      .def(
          "step", &step, "state"_a, "left0"_a, "right0"_a, "left1"_a, "right1"_a, "dt"_a,
          "velocities"_a = py::none(), "directions"_a = py::none(), "time"_a = 0.0,
          R"(Advances `state` in place by `dt` > 0 [s] while the tips move from left0, right0 to left1, right1,
each of the shape (3,) [m].

`velocities` [m/s] are those of left0, right0, left1, right1; without them the tips go straight at constant
speed. `directions`, unit vectors, are those of the sticks at the same four instants, zero where not known;
StickFlex alone looks at them. `time` [s] is that of left0, for FormulaLaws. Raises FloatingPointError, and
leaves the state as it was, where the result is not finite.)");
}

}  // namespace diabolo::python
