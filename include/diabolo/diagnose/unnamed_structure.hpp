// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "diabolo/diagnose/estimate.hpp"

// Parts of a DiagnosisResult, see diagnosis_result.hpp: what has no name, and the laws learnt from it.
namespace diabolo {

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
    visit("gain", &LearntLawFound::gain, "What chi^2 falls by with it, in units of the dispersion.");
    visit("gain_by_strength", &LearntLawFound::gain_by_strength,
          "In chi^2, of held-out windows, where it is as strong in each as it is on average there; "
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

}  // namespace diabolo
