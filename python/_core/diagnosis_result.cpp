// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/diagnosis_result.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "diabolo/diagnose/best_guess.hpp"
#include "diabolo/json/diagnosis_file.hpp"

#include "bindings.hpp"
#include "records.hpp"

namespace diabolo::python {

using namespace py::literals;

namespace {

std::string summary(const DiagnosisResult& result) {
  return "<DiagnosisResult " + result.headline + ": " + result.sentence + ">";
}

}  // namespace

void bind_diagnosis_result(py::module_& module) {
  bind_record<Estimate>(module);
  bind_record<EffectPlace>(module);
  bind_record<EffectSize>(module);
  bind_record<ClaimedEffect>(module);
  bind_record<UnnamedPlace>(module);
  bind_record<UnnamedStructure>(module);
  bind_record<UpperLimit>(module);
  bind_record<HeldOutErrors>(module);
  bind_record<ProposedMotion>(module);
  bind_record<LadderRow>(module);
  bind_record<LocatedDirection>(module);
  bind_record<LocatedWindow>(module);
  bind_record<Location>(module);
  bind_record<RecordingNoise>(module);
  bind_record<Thresholds>(module);
  bind_record<InputFile>(module);
  bind_record<DiagnosisResult>(module, &summary)
      .def("to_json", &write_diagnosis, "The text of its file, schema diabolo.diagnosis/1.")
      .def_static(
          "from_json", [](const std::string& text) { return read_diagnosis(text, "diagnosis"); }, "text"_a,
          "Reads the text of such a file; what it lacks is as in an empty result.")
      .def_static("load", &load_diagnosis, "path"_a, Unlocked(), "Reads such a file.");
  module.attr("DIAGNOSIS_SCHEMA") = kDiagnosisSchema;
  module.def("diagnosis_schema", &diagnosis_schema, "The JSON schema of a diagnosis' file.");
  module.def("best_guess", &best_guess, "model"_a, "ladder"_a, "See diabolo.best_guess.");
}

}  // namespace diabolo::python
