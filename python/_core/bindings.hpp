// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

// Each function adds one topic to the module; module.cpp calls them in an order in which every type is known
// before it is used.
namespace diabolo::python {

/// Of a function that needs no interpreter: without its lock.
using Unlocked = pybind11::call_guard<pybind11::gil_scoped_release>;

void bind_parameters(pybind11::module_& module);
void bind_model(pybind11::module_& module);
void bind_state(pybind11::module_& module);
void bind_effects(pybind11::module_& module);
void bind_laws(pybind11::module_& module);
void bind_residual_force(pybind11::module_& module);
void bind_spheroid(pybind11::module_& module);
void bind_tip_motion(pybind11::module_& module);
void bind_calibration(pybind11::module_& module);
void bind_recording(pybind11::module_& module);
void bind_tracked_take(pybind11::module_& module);
void bind_recording_file(pybind11::module_& module);
void bind_played_recording(pybind11::module_& module);
void bind_predictor(pybind11::module_& module);
void bind_host(pybind11::module_& module);
void bind_evaluation(pybind11::module_& module);
void bind_rollout(pybind11::module_& module);
void bind_gradient(pybind11::module_& module);
void bind_diagnosis_result(pybind11::module_& module);
void bind_diagnosis(pybind11::module_& module);
void bind_residual_fit(pybind11::module_& module);
void bind_level(pybind11::module_& module);
void bind_player(pybind11::module_& module);
void bind_robot(pybind11::module_& module);
void bind_estimate(pybind11::module_& module);
void bind_learn(pybind11::module_& module);

}  // namespace diabolo::python
