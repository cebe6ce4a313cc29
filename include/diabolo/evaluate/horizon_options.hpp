// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/evaluate/evaluation_step.hpp"
#include "diabolo/evaluate/start_state.hpp"
#include "diabolo/math/parallel.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// Longest horizon that can be asked for [s]: a minute.
inline constexpr double kLongestHorizon = 60.0;

/// How the multi-start evaluation is done.
struct HorizonOptions {
  double starts_every = 0.1;                               ///< [s]
  std::vector<double> horizons{0.1, 0.25, 0.5, 1.0, 2.0};  ///< after the start [s]
  Start start = Start::kFair;
  double unseen_spin = 0.0;  ///< of starts on a recording that never shows the spin [rad/s]
  std::uint64_t seed = 1;    ///< of the bootstrap
  int threads = 0;           ///< 0: one for every processor; the result is the same
};

/// Throws std::invalid_argument where an option is out of its range.
inline void check_options(const HorizonOptions& options) {
  if (!(options.starts_every >= kEvaluationStep) || !std::isfinite(options.starts_every))
    throw std::invalid_argument("starts_every: " + shown(options.starts_every) + " s; must be at least " +
                                shown(kEvaluationStep) + " s and finite");
  if (options.horizons.empty()) throw std::invalid_argument("horizons: none; at least one expected");
  for (const double horizon : options.horizons)
    if (!(horizon > 0.0 && horizon <= kLongestHorizon))
      throw std::invalid_argument("horizon: " + shown(horizon) + " s; must be > 0 and at most " +
                                  shown(kLongestHorizon) + " s");
  check_threads(options.threads);
}

}  // namespace diabolo
