// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diabolo/diagnose/estimate.hpp"

// Parts of a DiagnosisResult, see diagnosis_result.hpp: how well it predicts what it did not see.
namespace diabolo {

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
    visit("improvement_ci95_m", &HeldOutErrors::improvement_ci95_m,
          "95 % interval of base less augmented, an error counting at most three times the median.");
    visit("start_error_m", &HeldOutErrors::start_error_m, "What the noise of the starts alone makes.");
    visit("base_spin_error_radps", &HeldOutErrors::base_spin_error_radps,
          "Mean spin error of the base; null where no spin was seen.");
    visit("augmented_spin_error_radps", &HeldOutErrors::augmented_spin_error_radps,
          "The same with what was found.");
    visit("spin_improvement_ci95_radps", &HeldOutErrors::spin_improvement_ci95_radps,
          "95 % interval of base less augmented.");
    visit("start_spin_error_radps", &HeldOutErrors::start_spin_error_radps,
          "What the noise of the starts alone makes: of their spin, and of position and velocity through the "
          "string.");
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

}  // namespace diabolo
