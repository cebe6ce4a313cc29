// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diabolo/recording/recording.hpp"

// Parts of a DiagnosisResult, see diagnosis_result.hpp: where base and recordings part.
namespace diabolo {

struct LocatedDirection {
  static constexpr const char* kName = "LocatedDirection";
  static constexpr const char* kDoc = "A direction in which something may be missing.";

  std::string name, mode, unit;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("name", &LocatedDirection::name, "");
    visit("mode", &LocatedDirection::mode, "State of the string in which it is looked at.");
    visit("unit", &LocatedDirection::unit, "");
  }
};

struct LocatedWindow {
  static constexpr const char* kName = "LocatedWindow";
  static constexpr const char* kDoc = "What is missing in a window of a recording.";

  std::string recording;
  double begin_s = kNaN, end_s = kNaN;
  std::string mode;
  double residual_before_m = kNaN, residual_after_m = kNaN;
  std::vector<std::optional<double>> z, z_after;
  std::optional<double> residual_noise_m, spin_before_rad_s, spin_after_rad_s, spin_noise_rad_s;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("recording", &LocatedWindow::recording, "By its name.");
    visit("begin_s", &LocatedWindow::begin_s, "");
    visit("end_s", &LocatedWindow::end_s, "");
    visit("mode", &LocatedWindow::mode, "State of the string at its begin.");
    visit("residual_before_m", &LocatedWindow::residual_before_m, "Root mean square of the base.");
    visit("residual_after_m", &LocatedWindow::residual_after_m, "The same with what was found.");
    visit("z", &LocatedWindow::z, "Of what is missing, direction by direction.");
    visit("z_after", &LocatedWindow::z_after, "Of what is left with what was found.");
    visit("residual_noise_m", &LocatedWindow::residual_noise_m, "What noise alone would leave.");
    visit("spin_before_rad_s", &LocatedWindow::spin_before_rad_s, "Root mean square of the base's spin.");
    visit("spin_after_rad_s", &LocatedWindow::spin_after_rad_s, "The same with what was found.");
    visit("spin_noise_rad_s", &LocatedWindow::spin_noise_rad_s, "What noise alone would leave.");
  }
};

struct Location {
  static constexpr const char* kName = "Location";
  static constexpr const char* kDoc = "Where base and recordings part.";

  std::vector<LocatedDirection> directions;
  std::vector<LocatedWindow> windows;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("directions", &Location::directions, "");
    visit("windows", &Location::windows, "");
  }
};

struct RecordingNoise {
  static constexpr const char* kName = "RecordingNoise";
  static constexpr const char* kDoc = "Noise of a recording.";

  std::string recording;
  double position_m = kNaN, spin_rad_s = kNaN;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("recording", &RecordingNoise::recording, "By its name.");
    visit("position_m", &RecordingNoise::position_m, "Standard deviation.");
    visit("spin_rad_s", &RecordingNoise::spin_rad_s, "Standard deviation.");
  }
};

}  // namespace diabolo
