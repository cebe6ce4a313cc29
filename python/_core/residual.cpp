// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/fit_residual.hpp"

#include <pybind11/stl.h>

#include <atomic>
#include <string>
#include <vector>

#include "diabolo/json/residual.hpp"
#include "diabolo/recording/check.hpp"

#include "bindings.hpp"
#include "interrupt.hpp"

namespace diabolo::python {

namespace py = pybind11;

namespace {

using namespace py::literals;
using Residual = ResidualForce<double>;

std::string residual_text(const Residual& force) { return force.law ? to_json(*force.law).dump() : "{}"; }

Residual residual_of_text(const std::string& text) {
  const nlohmann::json json = parse_json(text, "residual_force");
  return json.empty() ? Residual() : residual_from_json(JsonFields(json, "residual_force"));
}

py::object residual_dict(const Residual& force) {
  return py::module_::import("json").attr("loads")(residual_text(force));
}

/// By the text that a file would hold, so that both say the same of what is wrong.
Residual residual_from_fields(const py::kwargs& fields) {
  return residual_of_text(py::module_::import("json").attr("dumps")(fields).cast<std::string>());
}

ResidualFit fit_to_recordings(const std::vector<Recording>& recordings, const Model& base, int threads) {
  for (const Recording& recording : recordings) check_recording(recording);
  ResidualFit result;
  run_interruptibly([&](const std::atomic<bool>& cancel) {
    result =
        fit_residual(recordings, base, threads, {.progress = {}, .cancelled = [&] { return cancel.load(); }});
  });
  return result;
}

}  // namespace

void bind_residual_force(py::module_& module) {
  py::class_<Residual> cls(module, "ResidualForce", R"(A force that was learnt from what named physics leaves.

An acceleration in the string's frame by `fit_residual`: right along the tips, forward and level, up. Each is a sum of
weights [m/s^2] times what the diabolo does: its velocity, place, spin and slip, the string's pull, and the hands'
velocity. It fades out where nothing was seen, and neither its size nor its work are larger than there. Without
arguments there is none.)");
  cls.def(py::init(&residual_from_fields));
  cls.def("to_dict", &residual_dict,
          "largest, power, on_string and off_string, as the constructor takes them.");
  cls.def("__bool__", [](const Residual& force) { return !force.neutral(); });
  cls.def("__repr__", [](const Residual& force) {
    return force.neutral() ? std::string("ResidualForce()")
                           : "ResidualForce(**" + std::string(py::repr(residual_dict(force))) + ")";
  });
  cls.def(
      "__eq__",
      [](const Residual& a, const py::object& other) {
        return py::isinstance<Residual>(other) && same_residual(a, other.cast<const Residual&>());
      },
      "other"_a);
  cls.def("__copy__", [](const Residual& force) { return force; });
  cls.def(
      "__deepcopy__", [](const Residual& force, const py::dict&) { return force; }, "memo"_a);
  cls.def(py::pickle(&residual_text, &residual_of_text));
}

void bind_residual_fit(py::module_& module) {
  py::class_<ResidualFit>(module, "ResidualFit",
                          "A residual that was fitted, and its errors on what it was not fitted to.")
      .def_readonly("model", &ResidualFit::model, "The base, with the residual where it stands.")
      .def_readonly("stands", &ResidualFit::stands,
                    "Whether predictions get better by more than 1 mm half a second later, for sure.")
      .def_readonly("usual", &ResidualFit::usual, "The size that weights were expected to have [m/s^2].")
      .def_readonly("windows", &ResidualFit::windows, "How many predictions were compared.")
      .def_readonly("base_error", &ResidualFit::base_error,
                    "Median distance without it, half a second later [m].")
      .def_readonly("error", &ResidualFit::error, "The same with it [m].")
      .def_property_readonly(
          "gain_ci95",
          [](const ResidualFit& fit) -> py::object {
            if (!fit.gain_ci95) return py::none();
            return py::make_tuple(fit.gain_ci95->low, fit.gain_ci95->high);
          },
          "95 % interval of the mean by which it takes errors off [m]; None where there are too few.");
  module.def("fit_residual", &fit_to_recordings, "recordings"_a, "base"_a, "threads"_a);
}

}  // namespace diabolo::python
