// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diabolo/diagnose/estimate.hpp"

// Parts of a DiagnosisResult, see diagnosis_result.hpp: what is claimed, where it matters and how much it
// does.
namespace diabolo {

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

}  // namespace diabolo
