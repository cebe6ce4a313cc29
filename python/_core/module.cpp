// SPDX-License-Identifier: MIT
#include <system_error>

#include "diabolo/version.hpp"

#include "arguments.hpp"
#include "bindings.hpp"
#include "pickles.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace diabolo::python;
  module.doc() = "Compiled core of diabolo: the header-only C++ library, bound for Python.";
  module.attr("__version__") = diabolo::kVersion;
  bind_parameters(module);
  bind_effects(module);
  bind_laws(module);
  bind_residual_force(module);
  bind_model(module);
  bind_state(module);
  bind_calibration(module);
  bind_recording(module);
  bind_tracked_take(module);
  bind_recording_file(module);
  bind_played_recording(module);
  bind_spheroid(module);
  bind_tip_motion(module);
  bind_predictor(module);
  bind_host(module);
  bind_rollout(module);
  bind_gradient(module);
  bind_evaluation(module);
  bind_diagnosis_result(module);
  bind_diagnosis(module);
  bind_residual_fit(module);
  bind_learn(module);
  bind_player(module);  // plays what an agent learns from
  bind_level(module);   // plays along a path
  bind_robot(module);
  bind_estimate(module);  // takes an arm's torques
  bind_pickles();
  check_arguments(module);
  pybind11::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const std::system_error& error) {  // of a thread that the system has no room for
      if (error.code() != std::errc::resource_unavailable_try_again) throw;
      PyErr_SetString(PyExc_MemoryError, "no further thread can be started");
    }
  });
}
