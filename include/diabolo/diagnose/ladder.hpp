// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diabolo/recording/recording.hpp"

// Parts of a DiagnosisResult, see diagnosis_result.hpp: all candidates, and what would part them.
namespace diabolo {

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

}  // namespace diabolo
