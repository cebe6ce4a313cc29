// SPDX-License-Identifier: MIT
#include "diabolo/version.hpp"

#include "bindings.hpp"

PYBIND11_MODULE(_core, module) {
  module.doc() = "Compiled core of diabolo: the header-only C++ library, bound for Python.";
  module.attr("__version__") = diabolo::kVersion;
  diabolo::python::bind_parameters(module);
  diabolo::python::bind_effects(module);
  diabolo::python::bind_state(module);
  diabolo::python::bind_spheroid(module);
  diabolo::python::bind_tip_motion(module);
  diabolo::python::bind_predictor(module);
  diabolo::python::bind_rollout(module);
  diabolo::python::bind_gradient(module);
}
