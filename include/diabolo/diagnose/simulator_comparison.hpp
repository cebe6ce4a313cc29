// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diabolo/diagnose/diagnosis_result.hpp"

namespace diabolo {

inline constexpr const char* kComparisonSchema = "diabolo.comparison/1";

struct ComparedLaw {
  static constexpr const char* kName = "ComparedLaw";
  static constexpr const char* kDoc = "A law in reality and in a simulator.";

  std::string name, kind, what, verdict;
  std::vector<std::string> tied_with;
  std::optional<double> p_value;
  std::vector<Estimate> real, simulated, difference;
  EffectPlace where;
  std::optional<double> size_m, axle_1s_rad;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("name", &ComparedLaw::name, "Of the candidate, or of a law that was learnt.");
    visit("kind", &ComparedLaw::kind, "physics, measurement or learnt.");
    visit("what", &ComparedLaw::what, "In words.");
    visit(
        "verdict", &ComparedLaw::verdict,
        "agrees, lacks, too_little, too_much or should_not_have, of the simulator; cannot_tell where one of "
        "the two shows it and the other is unsure.");
    visit("tied_with", &ComparedLaw::tied_with, "Candidates that explain the recordings as well.");
    visit("p_value", &ComparedLaw::p_value, "That the two are the same, over all candidates.");
    visit("real", &ComparedLaw::real, "What it comes out as in the recordings.");
    visit("simulated", &ComparedLaw::simulated, "What it comes out as in the simulated ones.");
    visit("difference", &ComparedLaw::difference, "Real less simulated: what the simulator has to get.");
    visit("where", &ComparedLaw::where, "Where it matters.");
    visit("size_m", &ComparedLaw::size_m,
          "How far the difference moves a free diabolo in 0.5 s; null where it does not act so.");
    visit("axle_1s_rad", &ComparedLaw::axle_1s_rad,
          "How far the difference turns the axle in 1 s; null where it does not act so.");
  }
};

/// See docs/your_simulator.md; compare_simulator() makes it.
struct SimulatorComparison {
  static constexpr const char* kName = "SimulatorComparison";
  static constexpr const char* kDoc = "What reality has and a simulator has not, law by law.";

  std::string schema = kComparisonSchema, sentence;
  std::vector<ComparedLaw> laws;
  std::vector<std::string> recording_faults;
  HeldOutErrors fit;
  DiagnosisResult real, simulated;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("schema", &SimulatorComparison::schema, "diabolo.comparison/1.");
    visit("sentence", &SimulatorComparison::sentence, "The answer in words.");
    visit("laws", &SimulatorComparison::laws, "What differs, the largest first, and then what agrees.");
    visit("recording_faults", &SimulatorComparison::recording_faults,
          "Faults of the recordings, which no simulator has to have.");
    visit("fit", &SimulatorComparison::fit,
          "Errors of the simulator on data that was not fitted, alone and with the difference of our two "
          "models; without horizons where it was not asked to play from recorded starts.");
    visit("real", &SimulatorComparison::real, "Diagnosis of the recordings.");
    visit("simulated", &SimulatorComparison::simulated, "Diagnosis of what was simulated.");
  }
};

}  // namespace diabolo
