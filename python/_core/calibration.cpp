// SPDX-License-Identifier: MIT
#include "diabolo/recording/formats/calibration.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>
#include <vector>

#include "diabolo/json/calibration_file.hpp"

#include "bindings.hpp"

namespace diabolo::python {

namespace py = pybind11;

namespace {

using namespace py::literals;

Calibration of_setup(Calibration calibration, const DiaboloProperties& properties, double string_length,
                     const std::vector<std::string>& assumed) {
  calibration.properties = properties;
  calibration.string_length = string_length;
  calibration.assumed = assumed;
  check_calibration(calibration, "setup");
  return calibration;
}

/// A calibration for bodies of these names; empty ones stay as they are.
Calibration renamed(Calibration calibration, const std::string& left, const std::string& right,
                    const std::string& diabolo) {
  if (!left.empty()) calibration.left.bodies = {left};
  if (!right.empty()) calibration.right.bodies = {right};
  if (!diabolo.empty()) calibration.diabolo.bodies = {diabolo};
  check_calibration(calibration, "topics");
  return calibration;
}

void bind_properties(py::module_& module) {
  using Properties = DiaboloProperties;
  const auto make_properties = [](double mass, double diameter, double length, double axle_radius) {
    const Properties properties{mass, diameter, length, axle_radius};
    check_properties(properties, kPublishedStringLength, "DiaboloProperties");
    return properties;
  };
  py::class_<Properties>(module, "DiaboloProperties", "What a diabolo is like.")
      .def(py::init(make_properties), "mass"_a, "diameter"_a, "length"_a, "axle_radius"_a = 0.0065)
      .def_static(
          "red", [] { return kRedDiabolo; }, "The paper's red diabolo, without markers.")
      .def_static(
          "blue", [] { return kBlueDiabolo; }, "The blue one, which runs on a bearing.")
      .def_static("patterned", [] { return kPatternedDiabolo; })
      .def_static("green", [] { return kGreenDiabolo; })
      .def_readonly("mass", &Properties::mass, "[kg]")
      .def_readonly("diameter", &Properties::diameter, "Of the cups [m].")
      .def_readonly("length", &Properties::length, "Along the axle [m].")
      .def_readonly("axle_radius", &Properties::axle_radius, "Where the string runs [m].")
      .def("__repr__", [](const Properties& p) {
        return py::str("DiaboloProperties(mass={!r}, diameter={!r}, length={!r}, axle_radius={!r})")
            .format(p.mass, p.diameter, p.length, p.axle_radius);
      });
}

}  // namespace

void bind_calibration(py::module_& module) {
  bind_properties(module);
  py::class_<Calibration>(
      module, "Calibration",
      "How the rigid bodies of a Motive take become the tips and the diabolo of a recording.")
      .def_static("published", &published_calibration,
                  "Of the red diabolo with the sticks of July 2020; the default.")
      .def_static("plain", &plain_calibration,
                  "Of bodies that are the tips and the diabolo themselves, in the world frame.")
      .def("renamed", &renamed, "left"_a = "", "right"_a = "", "diabolo"_a = "",
           "The same for bodies of these names, where one is given.")
      .def("of", &of_setup, "properties"_a, "string_length"_a, "assumed"_a = std::vector<std::string>{},
           "The same for a diabolo and a string [m]; assumed: as that of a Recording.")
      .def("completed_by", &completed, "setup"_a,
           "The same with string and diabolo of another where it only assumes them.")
      .def_static("blue", &blue_calibration, "Of the blue diabolo; its tips are only estimates.")
      .def_static("load", &load_calibration, "path"_a, Unlocked(),
                  "Reads a file of the schema diabolo.calibration/1.")
      .def("save", &save_calibration, "path"_a, Unlocked(), "Writes it, whole or not at all.")
      .def("to_json", &write_calibration, "The text of its file.");
}

}  // namespace diabolo::python
