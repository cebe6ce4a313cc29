// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "diabolo/math/dual.hpp"
#include "diabolo/math/parallel.hpp"
#include "diabolo/rollout.hpp"

#include "arrays.hpp"
#include "bindings.hpp"
#include "diabolo/model.hpp"
#include "interrupt.hpp"

#include "effects.hpp"
#include "state.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

constexpr int kChunk = 8;  // derivatives carried along at once
using D = Dual<double, kChunk>;

/// Everything that a rollout depends on, in numbers that carry derivatives.
struct Inputs {
  Parameters<D> parameters;
  AllEffects<D> effects;
  State<D> state;
  std::vector<Vector3<D>> left, right, left_directions, right_directions;

  Inputs(const Model& model, const State<double>& initial, const TipMotion<double>& tips) {
    for (std::size_t i = 0; i < tips.size(); ++i) {
      const Tips<double> pose = tips.pose(i);
      left.push_back(pose.left.cast<D>());
      right.push_back(pose.right.cast<D>());
      left_directions.push_back(pose.left_direction.cast<D>());
      right_directions.push_back(pose.right_direction.cast<D>());
    }
    parameters = parameters_in<D>(model.parameters);
    copy_effects(model.effects, effects);
    state = state_in<D>(initial);
  }

  /// Shape of the named input, () for a number. Throws std::invalid_argument where there is none.
  std::vector<py::ssize_t> shape(const std::string& name) {
    if (name == "position" || name == "velocity") return {3};
    if (name == "left" || name == "right") return {static_cast<py::ssize_t>(left.size()), 3};
    if (name != "spin" && !find_field(name))
      throw std::invalid_argument("with_respect_to: '" + name +
                                  "'; expected position, velocity, spin, left, right, a field of Parameters, "
                                  "or an effect and its field as in string_elasticity.compliance");
    return {};
  }

  /// Component number `i` of the named input.
  D& component(const std::string& name, std::size_t i) {
    const Eigen::Index axis = static_cast<Eigen::Index>(i % 3);
    if (name == "position") return state.position[axis];
    if (name == "velocity") return state.velocity[axis];
    if (name == "left") return left[i / 3][axis];
    if (name == "right") return right[i / 3][axis];
    return name == "spin" ? state.spin : *find_field(name);
  }

 private:
  D* find_field(const std::string& name) {
    D* found = nullptr;
    const auto look_in = [&](auto& fields, const std::string& prefix) {
      std::remove_reference_t<decltype(fields)>::for_each(fields, [&](const ParameterInfo& info, D& field) {
        if (name == prefix + std::string(info.name)) found = &field;
      });
    };
    look_in(parameters, "");
    for_each_effect(effects, [&](auto& effect) { look_in(effect, std::string(effect.kName) + "."); });
    return found;
  }
};

State<D> run(const Inputs& inputs, const TipMotion<double>& tips, const Steps& steps,
             const std::atomic<bool>& cancel) {
  const FullPredictor<D> predictor(inputs.parameters, inputs.effects);
  TipMotion<D> motion(tips.times(), inputs.left, inputs.right, tips.interpolation());
  motion.point_along(inputs.left_directions, inputs.right_directions);
  motion.start_clock(tips.clock());
  return diabolo::rollout(predictor, inputs.state, motion, steps,
                          [&](std::size_t, double, const State<D>&, const StepStatus<D>&) {
                            if (cancel) throw Cancelled();
                          });
}

std::array<D, 7> flat(const State<D>& s) {
  return {s.position[0], s.position[1], s.position[2], s.velocity[0], s.velocity[1], s.velocity[2], s.spin};
}

/// One input component, by which a final state is to be derived.
struct Seed {
  std::size_t input, index;
};

struct Derivatives {
  std::vector<std::vector<double>> of_input;  ///< per input: 7 x its number of components
  std::vector<double> state = std::vector<double>(7);
  StringState string_state{};
};

void expect_finite(const Derivatives& derivatives, const std::vector<std::string>& names) {
  const auto fail = [](const std::string& text) {
    PyErr_SetString(PyExc_FloatingPointError, ("rollout_gradient: " + text + " is not finite").c_str());
    throw py::error_already_set();
  };
  const auto finite = [](const std::vector<double>& numbers) {
    return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
  };
  if (!finite(derivatives.state)) fail("the final state");
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!finite(derivatives.of_input[i])) fail("the derivative with respect to " + names[i]);
}

/// Fills `result` chunk by chunk, on several threads. Throws Cancelled.
void differentiate(const Inputs& nominal, const std::vector<std::string>& names,
                   const std::vector<Seed>& seeds, const TipMotion<double>& tips, const Steps& steps,
                   int threads, const std::atomic<bool>& cancel, Derivatives& result) {
  const std::size_t chunks = std::max<std::size_t>(1, (seeds.size() + kChunk - 1) / kChunk);
  for_each_index(chunks, threads, {}, [&](std::size_t chunk) {
    const std::size_t first = chunk * kChunk, last = std::min(first + kChunk, seeds.size());
    Inputs inputs = nominal;
    for (std::size_t k = first; k < last; ++k)
      inputs.component(names[seeds[k].input], seeds[k].index).gradient[static_cast<int>(k - first)] = 1.0;
    const State<D> end = run(inputs, tips, steps, cancel);
    const std::array<D, 7> numbers = flat(end);
    for (std::size_t k = first; k < last; ++k) {
      std::vector<double>& of_input = result.of_input[seeds[k].input];
      const std::size_t columns = of_input.size() / 7;
      for (std::size_t row = 0; row < 7; ++row)
        of_input[row * columns + seeds[k].index] = numbers[row].gradient[static_cast<int>(k - first)];
    }
    if (chunk == 0) {
      std::ranges::transform(numbers, result.state.begin(), [](const D& x) { return x.value; });
      result.string_state = end.string_state;
    }
  });
}

py::tuple rollout_gradient(const Model& model, const State<double>& initial, const TipMotion<double>& tips,
                           const std::vector<std::string>& with_respect_to, double begin, double dt,
                           std::size_t steps_to_take, int threads) {
  const Steps steps{begin, dt, steps_to_take};
  steps.validate();
  FullPredictor<double>(model.parameters, model.effects);  // speaks about values out of range
  Inputs nominal(model, initial, tips);
  std::vector<Seed> seeds;
  Derivatives result;
  std::vector<std::vector<py::ssize_t>> shapes;
  for (std::size_t i = 0; i < with_respect_to.size(); ++i) {
    std::vector<py::ssize_t> shape = nominal.shape(with_respect_to[i]);
    std::size_t count = 1;
    for (const py::ssize_t extent : shape) count *= static_cast<std::size_t>(extent);
    for (std::size_t k = 0; k < count; ++k) seeds.push_back({i, k});
    shape.insert(shape.begin(), 7);
    shapes.push_back(std::move(shape));
    result.of_input.emplace_back(7 * count);
  }
  run_interruptibly([&](const std::atomic<bool>& cancel) {
    differentiate(nominal, with_respect_to, seeds, tips, steps, threads, cancel, result);
  });
  expect_finite(result, with_respect_to);
  py::dict derivatives;
  for (std::size_t i = 0; i < with_respect_to.size(); ++i)
    derivatives[py::str(with_respect_to[i])] = Array(shapes[i], result.of_input[i].data());
  return py::make_tuple(Array(7, result.state.data()), string_state_to_python(result.string_state),
                        derivatives);
}

}  // namespace

void bind_gradient(py::module_& module) {
  module.def("rollout_gradient", &rollout_gradient, "model"_a, "initial"_a, "tips"_a, "with_respect_to"_a,
             "begin"_a, "dt"_a, "steps"_a, "threads"_a, "See diabolo.rollout_gradient.");
}

}  // namespace diabolo::python
