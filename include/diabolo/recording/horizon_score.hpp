// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "diabolo/recording/bootstrap.hpp"
#include "diabolo/recording/model.hpp"
#include "diabolo/recording/parallel.hpp"
#include "diabolo/recording/start_state.hpp"

namespace diabolo {

/// How the multi-start evaluation is done.
struct HorizonOptions {
  double starts_every = 0.1;                               ///< [s]
  std::vector<double> horizons{0.1, 0.25, 0.5, 1.0, 2.0};  ///< after the start [s]
  Start start = Start::kFair;
  std::uint64_t seed = 1;  ///< of the bootstrap
  int threads = 2;         ///< 1 or 2; the result is the same
};

/// Position errors at one horizon, over all starts.
struct HorizonScore {
  double horizon = 0.0;                  ///< after the start [s]
  std::size_t windows = 0;               ///< starts that could be compared
  std::size_t failed = 0;                ///< of these: the prediction diverged; left out of `model`
  std::size_t missed_catches = 0;        ///< of these: predicted in flight below the tips, so never caught
  std::optional<ErrorSummary> model;     ///< none where nothing could be compared
  std::optional<ErrorSummary> baseline;  ///< over all windows
  /// How much smaller the model's error is than the baseline's in the same window, mean [m].
  std::optional<double> advantage;
  std::optional<Interval> advantage_ci95;
};

/// Errors at each horizon over starts in one recording, or in all of several. Throws std::invalid_argument
/// about options, RecordingError about recordings, Cancelled.
std::vector<HorizonScore> score_horizons(const std::vector<const Recording*>& recordings, const Model& model,
                                         const HorizonOptions& options = {}, const Watch& watch = {});
std::vector<HorizonScore> score_horizons(const Recording& recording, const Model& model,
                                         const HorizonOptions& options = {}, const Watch& watch = {});

}  // namespace diabolo
