// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "batch.hpp"
#include "bindings.hpp"
#include "diabolo/model.hpp"
#include "interrupt.hpp"
#include "state.hpp"

#include "effects.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;
using Codes = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;

/// An array that takes over the numbers without copying them.
template <class T>
py::array_t<T> to_array(std::vector<T>&& numbers, const std::vector<py::ssize_t>& shape) {
  auto owner = std::make_unique<std::vector<T>>(std::move(numbers));
  T* const data = owner->data();
  const py::capsule keeper(owner.release(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array_t<T>(shape, data, keeper);
}

std::vector<State<double>> to_states(const Array& initial, const Codes& string_states) {
  expect_shape(initial, "initial", {kAny, 14});
  expect_finite(initial, "initial");
  expect_shape(string_states, "string_states", {initial.shape(0)});
  std::vector<State<double>> states(static_cast<std::size_t>(initial.shape(0)));
  const double* from = initial.data();
  const std::uint8_t* code = string_states.data();
  for (State<double>& state : states) {
    if (*code > static_cast<std::uint8_t>(StringState::kFlying))
      throw std::invalid_argument("string_states: " + std::to_string(*code) + "; expected 0, 1 or 2");
    state.position = {from[0], from[1], from[2]};
    state.velocity = {from[3], from[4], from[5]};
    state.spin = from[6];
    state.axis = {from[7], from[8], from[9]};
    state.tumble = {from[10], from[11], from[12]};
    state.turns = to_turns(from[13]);
    check_tumble(state.tumble, state.axis);
    state.string_state = static_cast<StringState>(*code);
    from += 14;
    ++code;
  }
  return states;
}

/// Raises FloatingPointError that names the first rollout that is not finite at its end.
void expect_finite_end(const std::vector<double>& records, std::size_t frames) {
  for (std::size_t i = 0; frames > 0 && i < records.size() / (7 * frames); ++i)
    for (std::size_t frame = 0; frame < frames; ++frame)
      for (std::size_t k = 0; k < 7; ++k) {
        if (std::isfinite(records[(i * frames + frame) * 7 + k])) continue;
        const std::string text = "rollout " + std::to_string(i) +
                                 ": the state is no longer finite at frame " + std::to_string(frame);
        PyErr_SetString(PyExc_FloatingPointError, text.c_str());
        throw py::error_already_set();
      }
}

py::tuple rollout(const std::vector<Model>& models, const Array& initial, const Codes& string_states,
                  const std::vector<std::shared_ptr<TipMotion<double>>>& tips, double begin, double dt,
                  std::size_t steps, std::size_t record_every, int threads, bool forces, bool axles) {
  Batch batch;
  batch.initial = to_states(initial, string_states);
  batch.effects.clear();
  for (const Model& model : models) {
    batch.parameters.push_back(model.parameters);
    batch.effects.push_back(model.effects);
  }
  for (const auto& motion : tips) batch.motions.push_back(motion.get());
  batch.steps = {begin, dt, steps};
  batch.record_every = record_every;
  batch.forces = forces;
  batch.axles = axles;
  BatchResult result;
  run_interruptibly([&](const std::atomic<bool>& cancel) { result = run_batch(batch, threads, cancel); });
  expect_finite_end(result.records, batch.records());
  const py::ssize_t n = initial.shape(0), frames = static_cast<py::ssize_t>(batch.records());
  std::vector<std::uint8_t> codes(result.record_states.size());
  for (std::size_t i = 0; i < codes.size(); ++i)
    codes[i] = static_cast<std::uint8_t>(result.record_states[i]);
  py::object on_tips = py::none(), axle = py::none();
  if (forces) on_tips = to_array(std::move(result.forces), {n, frames, 2, 3});
  expect_finite_end(result.axles, axles ? batch.records() : 0);
  if (axles) axle = to_array(std::move(result.axles), {n, frames, 7});
  return py::make_tuple(to_array(std::move(result.records), {n, frames, 7}),
                        to_array(std::move(codes), {n, frames}), on_tips, axle);
}

}  // namespace

void bind_rollout(py::module_& module) {
  module.def("rollout", &rollout, "models"_a, "initial"_a, "string_states"_a, "tips"_a, "begin"_a, "dt"_a,
             "steps"_a, "record_every"_a, "threads"_a, "forces"_a, "axles"_a,
             "See diabolo.rollout, which checks and broadcasts what it hands over.");
}

}  // namespace diabolo::python
