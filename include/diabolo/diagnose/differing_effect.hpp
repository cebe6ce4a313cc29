// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "diabolo/diagnose/estimate.hpp"

// Parts of a DiagnosisResult, see diagnosis_result.hpp: what recordings do not agree on.
namespace diabolo {

struct ParametersAlone {
  static constexpr const char* kName = "ParametersAlone";
  static constexpr const char* kDoc = "What something comes out as where one recording is fitted by itself.";

  std::string recording;
  std::vector<Estimate> parameters;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("recording", &ParametersAlone::recording, "By its name.");
    visit("parameters", &ParametersAlone::parameters, "As of a claimed effect.");
  }
};

struct DifferingEffect {
  static constexpr const char* kName = "DifferingEffect";
  static constexpr const char* kDoc = "Something of which recordings ask for different values.";

  std::string name, kind, what;
  double z = kNaN;
  std::vector<ParametersAlone> recordings;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("name", &DifferingEffect::name, "Of the candidate.");
    visit("kind", &DifferingEffect::kind, "physics or measurement.");
    visit("what", &DifferingEffect::what, "In words.");
    visit("z", &DifferingEffect::z, "Standard deviations between the two that differ most.");
    visit("recordings", &DifferingEffect::recordings, "Each by itself.");
  }
};

}  // namespace diabolo
