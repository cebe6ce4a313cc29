// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "diabolo/evaluate/horizon_options.hpp"
#include "diabolo/evaluate/horizon_task.hpp"
#include "diabolo/math/bootstrap.hpp"
#include "diabolo/math/parallel.hpp"
#include "diabolo/model.hpp"

namespace diabolo {

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

/// Score at horizon number `h` [s] from the errors of all windows in order.
inline HorizonScore summarize_horizon(const std::vector<std::vector<WindowError>>& errors, std::size_t h,
                                      const HorizonOptions& options, std::mt19937_64& generator) {
  HorizonScore score;
  score.horizon = options.horizons[h];
  std::vector<double> model, baseline, advantage;
  for (const std::vector<WindowError>& window : errors) {
    const WindowError& error = window[h];
    if (!error.comparable) continue;
    ++score.windows;
    score.failed += error.failed ? 1 : 0;
    score.missed_catches += !error.failed && error.missed_catch ? 1 : 0;
    baseline.push_back(error.baseline);
    if (error.failed) continue;
    model.push_back(error.model);
    advantage.push_back(error.baseline - error.model);
  }
  // Windows overlap, and share data, up to this many starts apart.
  const std::size_t overlap = 1 + static_cast<std::size_t>(std::ceil(score.horizon / options.starts_every));
  score.model = summarize(model, overlap, generator);
  score.baseline = summarize(baseline, overlap, generator);
  if (const std::optional<ErrorSummary> difference = summarize(advantage, overlap, generator)) {
    score.advantage = difference->mean;
    score.advantage_ci95 = difference->mean_ci95;
  }
  return score;
}

/// Errors at each horizon over starts in all of several recordings. Throws std::invalid_argument about
/// options and the model, RecordingError about recordings, Cancelled.
inline std::vector<HorizonScore> score_horizons(const std::vector<const Recording*>& recordings,
                                                const Model& model, const HorizonOptions& options = {},
                                                const Watch& watch = {}) {
  check_options(options);
  std::vector<HorizonTask> tasks;
  std::vector<std::pair<std::size_t, std::size_t>> windows;  // task and number in it
  for (const Recording* recording : recordings) {
    tasks.emplace_back(*recording, model, options);
    for (std::size_t i = 0; i < tasks.back().size(); ++i) windows.emplace_back(tasks.size() - 1, i);
  }
  std::vector<std::vector<WindowError>> errors(windows.size());
  for_each_index(windows.size(), options.threads, watch,
                 [&](std::size_t i) { errors[i] = tasks[windows[i].first].errors(windows[i].second); });
  std::mt19937_64 generator(options.seed);
  std::vector<HorizonScore> scores;
  for (std::size_t h = 0; h < options.horizons.size(); ++h)
    scores.push_back(summarize_horizon(errors, h, options, generator));
  return scores;
}

/// The same for one recording.
inline std::vector<HorizonScore> score_horizons(const Recording& recording, const Model& model,
                                                const HorizonOptions& options = {}, const Watch& watch = {}) {
  return score_horizons(std::vector<const Recording*>{&recording}, model, options, watch);
}

}  // namespace diabolo
