// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diabolo/diagnose/adequacy.hpp"
#include "diabolo/diagnose/catch_rule.hpp"
#include "diabolo/diagnose/claimed_effect.hpp"
#include "diabolo/diagnose/differing_effect.hpp"
#include "diabolo/diagnose/held_out_errors.hpp"
#include "diabolo/diagnose/ladder.hpp"
#include "diabolo/diagnose/location.hpp"
#include "diabolo/diagnose/significance.hpp"
#include "diabolo/diagnose/unnamed_structure.hpp"
#include "diabolo/version.hpp"

// Each part of a result lists its fields once: for_each_field() calls visit(name, member, what it is). Files,
// their schema and the bindings are made from these lists. Units stand in the names.
namespace diabolo {

inline constexpr const char* kDiagnosisSchema = "diabolo.diagnosis/1";

/// Odds below which a motion that is proposed parts nothing.
inline constexpr double kWorthwhileOdds = 3.0;

struct Thresholds {
  static constexpr const char* kName = "Thresholds";
  static constexpr const char* kDoc = "What decided the claims, so that nobody has to copy it.";

  double physics = kSignificance, measurement = kSignificanceOfFault, worthwhile_odds = kWorthwhileOdds,
         numerical_share = kNumericalShare, times_noise = kTimesNoise;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("physics", &Thresholds::physics, "Standard deviations beyond which physics counts.");
    visit("measurement", &Thresholds::measurement, "The same of a fault of measurement.");
    visit("times_noise", &Thresholds::times_noise, "What is left may be so many times what noise leaves.");
    visit("worthwhile_odds", &Thresholds::worthwhile_odds, "Below these a proposed motion parts nothing.");
    visit("numerical_share", &Thresholds::numerical_share,
          "Share of what is left over, beyond which the base's numerical rules count.");
  }
};

struct InputFile {
  static constexpr const char* kName = "InputFile";
  static constexpr const char* kDoc = "A file that was diagnosed.";

  std::string file, sha256;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("file", &InputFile::file, "Name without folders.");
    visit("sha256", &InputFile::sha256, "");
  }
};

/// See docs/diagnosis.md; result_of() makes it.
struct DiagnosisResult {
  static constexpr const char* kName = "DiagnosisResult";
  static constexpr const char* kDoc = "Everything that a diagnosis says, as its file holds it.";

  std::string schema = kDiagnosisSchema, headline, sentence, base;
  std::vector<ClaimedEffect> effects;
  Adequacy adequacy;
  std::vector<UnnamedStructure> unnamed;
  std::vector<LearntLawFound> learnt;
  std::vector<DifferingEffect> differing;
  std::optional<CatchRule> catch_rule;
  std::vector<UpperLimit> upper_limits;
  std::vector<Estimate> nuisances;
  HeldOutErrors fit;
  std::vector<ProposedMotion> next_experiment;
  std::vector<std::string> not_done;
  std::vector<LadderRow> ladder;
  Location locate;
  std::vector<RecordingNoise> noise;
  Thresholds thresholds;
  std::optional<std::string> model;
  std::string version{kVersion};
  std::optional<double> seconds;
  std::vector<InputFile> inputs;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("schema", &DiagnosisResult::schema, "diabolo.diagnosis/1.");
    visit("headline", &DiagnosisResult::headline,
          "The first that holds of INSUFFICIENT_DATA, TIE, NAMED, MEASUREMENT_FAULT, NUMERICAL, "
          "UNNAMED_STRUCTURE and NOTHING_MISSING; NAMED of laws of the axle alone just before the last.");
    visit("sentence", &DiagnosisResult::sentence, "The answer in words.");
    visit("base", &DiagnosisResult::base, "Name of the simulator that was asked about.");
    visit("effects", &DiagnosisResult::effects, "What is claimed, the surest first.");
    visit("adequacy", &DiagnosisResult::adequacy, "Whether it leaves no more than noise would.");
    visit("unnamed", &DiagnosisResult::unnamed, "What is there and has no name.");
    visit("learnt", &DiagnosisResult::learnt, "Laws that were learnt from it.");
    visit("differing", &DiagnosisResult::differing,
          "What recordings ask different values of, the surest first.");
    visit("catch_rule", &DiagnosisResult::catch_rule,
          "That the simulator's catches are too strict; null where nothing says so.");
    visit("upper_limits", &DiagnosisResult::upper_limits, "What may be there unseen.");
    visit("nuisances", &DiagnosisResult::nuisances, "What was measured on the way.");
    visit("fit", &DiagnosisResult::fit, "Errors on data that was not fitted.");
    visit("next_experiment", &DiagnosisResult::next_experiment, "Motions that would part ties.");
    visit("not_done", &DiagnosisResult::not_done, "What budget, base or recordings kept from being asked.");
    visit("ladder", &DiagnosisResult::ladder, "Every candidate, and why it was claimed or not.");
    visit("locate", &DiagnosisResult::locate, "Where base and recording part, window by window.");
    visit("noise", &DiagnosisResult::noise, "Of each recording.");
    visit("thresholds", &DiagnosisResult::thresholds, "What decided the claims.");
    visit("model", &DiagnosisResult::model, "Name of the model's file; null where none was written.");
    visit("version", &DiagnosisResult::version, "Of the tool.");
    visit("seconds", &DiagnosisResult::seconds, "That it took; null where its caller did not say.");
    visit("inputs", &DiagnosisResult::inputs, "Files that were diagnosed, where its caller said so.");
  }
};

}  // namespace diabolo
