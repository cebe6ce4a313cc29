// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/diagnosis_result.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/diagnose/best_guess.hpp"
#include "diabolo/json/comparison_file.hpp"
#include "diabolo/json/diagnosis_file.hpp"

#include "bindings.hpp"
#include "records.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

void bind_parts(py::module_& module) {
  bind_record<ResidualAndNoise>(module);
  bind_record<ChangeInTime>(module);
  bind_record<Adequacy>(module);
  bind_record<Estimate>(module);
  bind_record<EffectPlace>(module);
  bind_record<EffectSize>(module);
  bind_record<ClaimedEffect>(module);
  bind_record<UnnamedPlace>(module);
  bind_record<UnnamedStructure>(module);
  bind_record<LearntLawFound>(module);
  bind_record<ParametersAlone>(module);
  bind_record<CatchRule>(module);
  bind_record<DifferingEffect>(module);
  bind_record<UpperLimit>(module);
  bind_record<HeldOutErrors>(module);
  bind_record<ProposedMotion>(module);
  bind_record<LadderRow>(module).def(py::init([](std::string name, double estimate, double z, bool claimed) {
                                       LadderRow row;
                                       row.name = std::move(name);
                                       row.estimate = estimate;
                                       row.z = z;
                                       row.claimed = claimed;
                                       return row;
                                     }),
                                     "name"_a, "estimate"_a, "z"_a, "claimed"_a);
  bind_record<LocatedDirection>(module);
  bind_record<LocatedWindow>(module);
  bind_record<Location>(module);
  bind_record<RecordingNoise>(module);
  bind_record<Thresholds>(module).def(py::init<>());
  bind_record<InputFile>(module).def(py::init([](std::string file, std::string sha256) {
                                       return InputFile{std::move(file), std::move(sha256)};
                                     }),
                                     "file"_a, "sha256"_a);
}

/// With what only its caller knows.
DiagnosisResult completed(DiagnosisResult result, std::optional<double> seconds,
                          std::vector<InputFile> inputs, std::optional<std::string> model) {
  result.seconds = seconds;
  result.inputs = std::move(inputs);
  result.model = std::move(model);
  return result;
}

}  // namespace

void bind_diagnosis_result(py::module_& module) {
  bind_parts(module);
  bind_record<DiagnosisResult>(module)
      .def("completed", &completed, "seconds"_a = py::none(), "inputs"_a = std::vector<InputFile>(),
           "model"_a = py::none(), "The same with what only its caller knows; the rest as it is.")
      .def("to_json", &write_diagnosis, "The text of its file, schema diabolo.diagnosis/1.")
      .def_static(
          "from_json", [](const std::string& text) { return read_diagnosis(text, "diagnosis"); }, "text"_a,
          "Reads the text of such a file; what it lacks is as in an empty result.")
      .def_static("load", &load_diagnosis, "path"_a, Unlocked(), "Reads such a file.");
  bind_record<ComparedLaw>(module);
  bind_record<SimulatorComparison>(module).def("to_json", &write_comparison,
                                               "The text of its file, schema diabolo.comparison/1.");
  module.attr("DIAGNOSIS_SCHEMA") = kDiagnosisSchema;
  module.def("diagnosis_schema", &diagnosis_schema, "The JSON schema of a diagnosis' file.");
  module.def("best_guess", &best_guess, "model"_a, "ladder"_a, "See diabolo.best_guess.");
}

}  // namespace diabolo::python
