// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diabolo/recording/recording.hpp"

// Parts of a DiagnosisResult, see diagnosis_result.hpp: whether what is left is as small as noise would leave
// it.
namespace diabolo {

/// What is left may be so many times what noise alone leaves, in the middle window. A camera also wanders,
/// which nothing in a recording tells from motion: as much as it flickers would make a factor of 1.4.
inline constexpr double kTimesNoise = 2.0;

struct ResidualAndNoise {
  static constexpr const char* kName = "ResidualAndNoise";
  static constexpr const char* kDoc =
      "What windows of half a second, or predictions of held-out data, leave over, and what noise would.";

  std::string quantity, unit, mode, direction, recording;
  double begin_s = kNaN, end_s = kNaN;
  std::optional<double> ahead_s;
  std::size_t windows = 0;
  double base = kNaN, left = kNaN, noise = kNaN, times_noise = kNaN, p_value = kNaN;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("quantity", &ResidualAndNoise::quantity, "position or spin.");
    visit("unit", &ResidualAndNoise::unit, "m or rad/s.");
    visit("mode", &ResidualAndNoise::mode, "State of the string; EVENT where it changes, ANY for all.");
    visit("direction", &ResidualAndNoise::direction, "forward, left or up where one leads; else empty.");
    visit("recording", &ResidualAndNoise::recording, "By its name; empty for all.");
    visit("begin_s", &ResidualAndNoise::begin_s, "Of the stretch of time.");
    visit("end_s", &ResidualAndNoise::end_s, "");
    visit("ahead_s", &ResidualAndNoise::ahead_s,
          "Of a prediction of held-out data; null for windows that are fitted.");
    visit("windows", &ResidualAndNoise::windows,
          "How many were looked at, of half a second each; or predictions.");
    visit("base", &ResidualAndNoise::base,
          "Left by the base in the median window, root mean square; ahead, the median error.");
    visit("left", &ResidualAndNoise::left, "The same with what was found.");
    visit("noise", &ResidualAndNoise::noise, "The same of noise alone.");
    visit("times_noise", &ResidualAndNoise::times_noise,
          "How many times the noise the middle window leaves.");
    visit("p_value", &ResidualAndNoise::p_value,
          "Chance that noise leaves more than noise in so many windows.");
  }
};

struct ChangeInTime {
  static constexpr const char* kName = "ChangeInTime";
  static constexpr const char* kDoc = "Something that is not what it was a moment ago, window by window.";

  std::string quantity, unit;
  double z = kNaN, size = kNaN;
  std::optional<double> trend_per_s, frequency_hz;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("quantity", &ChangeInTime::quantity, "What changes.");
    visit("unit", &ChangeInTime::unit, "Of its size.");
    visit("z", &ChangeInTime::z, "Standard deviations by which neighbouring windows agree too well.");
    visit("size", &ChangeInTime::size, "Root mean square of what neighbouring windows agree on.");
    visit("trend_per_s", &ChangeInTime::trend_per_s, "Where a steady change explains it best.");
    visit("frequency_hz", &ChangeInTime::frequency_hz, "Where an oscillation explains it best.");
  }
};

struct Adequacy {
  static constexpr const char* kName = "Adequacy";
  static constexpr const char* kDoc = "Whether the answer leaves no more than the camera's noise would.";

  std::optional<bool> adequate, base_adequate;
  std::optional<double> explained, spin_explained;
  std::vector<ResidualAndNoise> overall, places;
  std::vector<ChangeInTime> changes;

  template <class Visit>
  static void for_each_field(const Visit& visit) {
    visit("adequate", &Adequacy::adequate, "Null where it was not asked.");
    visit("base_adequate", &Adequacy::base_adequate, "The same of the base alone.");
    visit("explained", &Adequacy::explained,
          "Share of the base's gap of position, beyond noise, that the answer closes; null without a gap.");
    visit("spin_explained", &Adequacy::spin_explained, "The same of the spin.");
    visit("overall", &Adequacy::overall,
          "Over all windows: position and, where it was seen, spin; then predictions.");
    visit("places", &Adequacy::places,
          "Where more is left than noise leaves: fitted windows, then predictions, each the worst first.");
    visit("changes", &Adequacy::changes, "What is left and changes in time, the surest first.");
  }
};

}  // namespace diabolo
