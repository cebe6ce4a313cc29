// SPDX-License-Identifier: MIT
#include "diabolo/version.hpp"

#include "bindings.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace diabolo::python;
  module.doc() = "Compiled core of diabolo: the header-only C++ library, bound for Python.";
  module.attr("__version__") = diabolo::kVersion;
  bind_parameters(module);
  bind_effects(module);
  bind_model(module);
  bind_state(module);
  bind_recording(module);
  bind_spheroid(module);
  bind_tip_motion(module);
  bind_predictor(module);
  bind_rollout(module);
  bind_gradient(module);
  bind_evaluation(module);
  bind_diagnosis_result(module);
  bind_diagnosis(module);
  bind_player(module);
  bind_robot(module);
}
