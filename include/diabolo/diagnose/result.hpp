// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diabolo/math/bootstrap.hpp"
#include "diabolo/recording/recording.hpp"

// The parts of a DiagnosisResult. Each lists its fields once: for_each_field() calls visit(name, member, what
// it is). Files, their schema and the bindings are made from these lists. Units stand in the names.
namespace diabolo {

/// Interval of each horizon; nothing where it cannot be told.
using IntervalByHorizon = std::vector<std::optional<Interval>>;
using NumberByHorizon = std::vector<std::optional<double>>;

struct Estimate {
  static constexpr const char* kName = "Estimate";
  static constexpr const char* kDoc = "A number that was estimated.";

  std::string name;
  double value = kNaN;
  std::string unit;
  std::optional<Interval> ci90;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("name", &Estimate::name, "By its fixed name.");
    visit("value", &Estimate::value, "In its unit.");
    visit("unit", &Estimate::unit, "1 for a plain number.");
    visit("ci90", &Estimate::ci90, "90 % interval.");
  }
};

struct EffectPlace {
  static constexpr const char* kName = "EffectPlace";
  static constexpr const char* kDoc = "Where an effect matters.";

  std::vector<std::string> modes;
  std::string direction;
  std::vector<Interval> intervals;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("modes", &EffectPlace::modes, "States of the string in which it matters.");
    visit("direction", &EffectPlace::direction, "In which it acts.");
    visit("intervals", &EffectPlace::intervals, "When it matters [s].");
  }
};

struct EffectSize {
  static constexpr const char* kName = "EffectSize";
  static constexpr const char* kDoc = "What an effect does to a free diabolo; null where it does not act so.";

  std::optional<double> acceleration_mps2, position_1s_m, position_05s_m, spin_share_1s, axle_1s_rad;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("acceleration_mps2", &EffectSize::acceleration_mps2, "As a constant one would move it as far.");
    visit("position_1s_m", &EffectSize::position_1s_m, "How far it moves the diabolo in 1 s.");
    visit("position_05s_m", &EffectSize::position_05s_m, "How far it moves the diabolo in 0.5 s.");
    visit("spin_share_1s", &EffectSize::spin_share_1s, "Which share of the spin it changes in 1 s.");
    visit("axle_1s_rad", &EffectSize::axle_1s_rad, "How far it turns the axle in 1 s.");
  }
};

struct ClaimedEffect {
  static constexpr const char* kName = "ClaimedEffect";
  static constexpr const char* kDoc = "Something that is missing, or was measured wrongly, and is claimed.";

  std::string name, kind;
  bool material = false;
  std::vector<std::string> tied_with;
  std::optional<double> p_value, confidence;
  std::vector<Estimate> parameters;
  EffectPlace where;
  IntervalByHorizon worse_without_ci95_m, spin_worse_without_ci95_radps;
  std::optional<Interval> axle_worse_without_ci95_rad;
  EffectSize size;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("name", &ClaimedEffect::name, "Of the candidate.");
    visit("kind", &ClaimedEffect::kind, "physics, measurement or numerical.");
    visit("material", &ClaimedEffect::material, "Whether it is large enough to matter.");
    visit("tied_with", &ClaimedEffect::tied_with, "Candidates that explain as much in its place.");
    visit("p_value", &ClaimedEffect::p_value, "Over all candidates.");
    visit("confidence", &ClaimedEffect::confidence, "Chance that the name is right.");
    visit("parameters", &ClaimedEffect::parameters, "What it comes out as.");
    visit("where", &ClaimedEffect::where, "Where it matters.");
    visit("worse_without_ci95_m", &ClaimedEffect::worse_without_ci95_m,
          "By how much held-out data is predicted worse without it, 95 % interval of each horizon.");
    visit("spin_worse_without_ci95_radps", &ClaimedEffect::spin_worse_without_ci95_radps,
          "The same of the spin; null where it was not seen.");
    visit("axle_worse_without_ci95_rad", &ClaimedEffect::axle_worse_without_ci95_rad,
          "The same of the axle's direction, some second ahead; null of what does not turn it.");
    visit("size", &ClaimedEffect::size, "How much it does to a free diabolo.");
  }
};

struct UnnamedPlace {
  static constexpr const char* kName = "UnnamedPlace";
  static constexpr const char* kDoc = "Where something without a name acts.";

  std::string direction;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("direction", &UnnamedPlace::direction, "In which it acts.");
  }
};

struct UnnamedStructure {
  static constexpr const char* kName = "UnnamedStructure";
  static constexpr const char* kDoc = "Something that is there and has no name.";

  UnnamedPlace where;
  std::string law;
  double value = kNaN, deviation = kNaN;
  std::string unit;
  double z = kNaN, size_m = kNaN;
  std::string scalar, scalar_unit;
  double exponent = kNaN, exponent_deviation = kNaN;
  std::vector<std::array<double, 2>> curve;
  double explained = kNaN;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("where", &UnnamedStructure::where, "Where it acts.");
    visit("law", &UnnamedStructure::law, "In words.");
    visit("value", &UnnamedStructure::value, "Mean, in its unit.");
    visit("deviation", &UnnamedStructure::deviation, "Standard deviation of the mean.");
    visit("unit", &UnnamedStructure::unit, "");
    visit("z", &UnnamedStructure::z, "Standard deviations from zero.");
    visit("size_m", &UnnamedStructure::size_m, "How far it moves a free diabolo in 0.5 s.");
    visit("scalar", &UnnamedStructure::scalar, "Scalar of the motion that it grows with.");
    visit("scalar_unit", &UnnamedStructure::scalar_unit, "");
    visit("exponent", &UnnamedStructure::exponent, "Power of the scalar.");
    visit("exponent_deviation", &UnnamedStructure::exponent_deviation, "Its standard deviation.");
    visit("curve", &UnnamedStructure::curve, "Scalar, and the mean around it.");
    visit("explained", &UnnamedStructure::explained, "Share of what is left over.");
  }
};

struct LearntLawFound {
  static constexpr const char* kName = "LearntLawFound";
  static constexpr const char* kDoc = "A law that was learnt from what had no name; it is in the model.";

  std::string name, law, acts, formula;
  std::vector<Estimate> numbers;
  double gain = kNaN;
  std::optional<double> gain_by_strength, gain_permuted, dependence_p_value;
  IntervalByHorizon worse_without_ci95_m, spin_worse_without_ci95_radps;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("name", &LearntLawFound::name, "In the model's file.");
    visit("law", &LearntLawFound::law, "In words.");
    visit("acts", &LearntLawFound::acts, "What the formula is the size of, see FormulaLaws.");
    visit("formula", &LearntLawFound::formula, "Of the numbers and of FormulaLaws.variables().");
    visit("numbers", &LearntLawFound::numbers, "Of the formula, the size first.");
    visit("gain", &LearntLawFound::gain, "In chi^2, of windows that were left out.");
    visit("gain_by_strength", &LearntLawFound::gain_by_strength,
          "In chi^2, of windows that were left out, where it is as strong in each as it is on average there; "
          "null where it does not change from window to window, or too fast for them.");
    visit("gain_permuted", &LearntLawFound::gain_permuted,
          "The same once these strengths are exchanged among the windows, the median of many times.");
    visit("dependence_p_value", &LearntLawFound::dependence_p_value,
          "The chance that exchanged strengths gain as much: small where it depends on what it says.");
    visit("worse_without_ci95_m", &LearntLawFound::worse_without_ci95_m,
          "By how much held-out data is predicted worse without it, 95 % interval of each horizon.");
    visit("spin_worse_without_ci95_radps", &LearntLawFound::spin_worse_without_ci95_radps,
          "The same of the spin; null where it was not seen.");
  }
};

struct UpperLimit {
  static constexpr const char* kName = "UpperLimit";
  static constexpr const char* kDoc = "Physics that is not claimed: how much of it may still be there.";

  std::string name, parameter;
  double limit95 = kNaN;
  std::string unit;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("name", &UpperLimit::name, "Of the candidate that is not claimed.");
    visit("parameter", &UpperLimit::parameter, "");
    visit("limit95", &UpperLimit::limit95, "It is below this in size, at 95 %.");
    visit("unit", &UpperLimit::unit, "");
  }
};

struct HeldOutErrors {
  static constexpr const char* kName = "HeldOutErrors";
  static constexpr const char* kDoc = "Errors on data that was not fitted, horizon by horizon.";

  std::string heldout;
  std::vector<double> horizons_s;
  NumberByHorizon base_error_m, augmented_error_m;
  IntervalByHorizon improvement_ci95_m;
  NumberByHorizon start_error_m;
  NumberByHorizon base_spin_error_radps, augmented_spin_error_radps;
  IntervalByHorizon spin_improvement_ci95_radps;
  NumberByHorizon start_spin_error_radps;
  std::optional<std::string> axle_heldout;
  std::optional<double> axle_ahead_s, constant_axle_error_rad, base_axle_error_rad, augmented_axle_error_rad;
  std::optional<Interval> axle_improvement_ci95_rad;
  std::size_t windows = 0;
  std::vector<std::string> holdout_unused;
  std::size_t fitted_windows = 0, of_windows = 0;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("heldout", &HeldOutErrors::heldout, "recordings, or blocks of one.");
    visit("horizons_s", &HeldOutErrors::horizons_s, "After the start.");
    visit("base_error_m", &HeldOutErrors::base_error_m, "Mean position error of the base.");
    visit("augmented_error_m", &HeldOutErrors::augmented_error_m, "The same with what was found.");
    visit("improvement_ci95_m", &HeldOutErrors::improvement_ci95_m, "95 % interval of base less augmented.");
    visit("start_error_m", &HeldOutErrors::start_error_m, "What the noise of the starts alone makes.");
    visit("base_spin_error_radps", &HeldOutErrors::base_spin_error_radps,
          "Mean spin error of the base; null where no spin was seen.");
    visit("augmented_spin_error_radps", &HeldOutErrors::augmented_spin_error_radps,
          "The same with what was found.");
    visit("spin_improvement_ci95_radps", &HeldOutErrors::spin_improvement_ci95_radps,
          "95 % interval of base less augmented.");
    visit("start_spin_error_radps", &HeldOutErrors::start_spin_error_radps,
          "By how much the spins of the starts are off those around them.");
    visit("axle_heldout", &HeldOutErrors::axle_heldout,
          "recordings, or blocks of one, on which the axle is compared; null where it was not seen.");
    visit("axle_ahead_s", &HeldOutErrors::axle_ahead_s,
          "How long after the axle was seen its direction is compared, a mean; null where it was not seen.");
    visit("constant_axle_error_rad", &HeldOutErrors::constant_axle_error_rad,
          "Mean angle that an axle which keeps its direction is off then.");
    visit("base_axle_error_rad", &HeldOutErrors::base_axle_error_rad, "The same of the base.");
    visit("augmented_axle_error_rad", &HeldOutErrors::augmented_axle_error_rad,
          "The same with what was found.");
    visit("axle_improvement_ci95_rad", &HeldOutErrors::axle_improvement_ci95_rad,
          "95 % interval of base less augmented.");
    visit("windows", &HeldOutErrors::windows, "Predictions that were compared.");
    visit("holdout_unused", &HeldOutErrors::holdout_unused,
          "Held-out recordings without a start to compare.");
    visit("fitted_windows", &HeldOutErrors::fitted_windows, "Windows that were fitted.");
    visit("of_windows", &HeldOutErrors::of_windows, "Of so many; the others say least.");
  }
};

struct ProposedMotion {
  static constexpr const char* kName = "ProposedMotion";
  static constexpr const char* kDoc = "A motion that would tell ties apart.";

  std::string motion, what;
  std::vector<std::string> parts;
  std::optional<double> odds;
  double seconds = kNaN;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("motion", &ProposedMotion::motion, "By its name.");
    visit("what", &ProposedMotion::what, "In words.");
    visit("parts", &ProposedMotion::parts, "Candidates that are tied, and that it tells apart.");
    visit("odds", &ProposedMotion::odds, "Against the wrong one, to 1.");
    visit("seconds", &ProposedMotion::seconds, "To record.");
  }
};

struct LadderRow {
  static constexpr const char* kName = "LadderRow";
  static constexpr const char* kDoc = "A candidate, and what speaks for it.";

  std::string name, kind, parameter;
  double estimate = kNaN;
  std::string unit;
  double z = kNaN, p_value = kNaN;
  std::optional<double> size_m;
  bool claimed = false;
  std::string reason;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("name", &LadderRow::name, "Of the candidate.");
    visit("kind", &LadderRow::kind, "physics or measurement.");
    visit("parameter", &LadderRow::parameter, "Of several, the one that stands out most.");
    visit("estimate", &LadderRow::estimate, "Of the parameter.");
    visit("unit", &LadderRow::unit, "");
    visit("z", &LadderRow::z, "Standard deviations from zero.");
    visit("p_value", &LadderRow::p_value, "Over all candidates.");
    visit("size_m", &LadderRow::size_m,
          "How far it moves a free diabolo in 0.5 s; null where it acts on spin or axle.");
    visit("claimed", &LadderRow::claimed, "");
    visit("reason", &LadderRow::reason, "Why it is claimed, or not.");
  }
};

}  // namespace diabolo
