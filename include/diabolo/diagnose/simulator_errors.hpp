// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "diabolo/diagnose/held_out_errors.hpp"
#include "diabolo/diagnose/play_in_simulator.hpp"
#include "diabolo/evaluate/evaluation_step.hpp"
#include "diabolo/math/bootstrap.hpp"
#include "diabolo/rollout.hpp"

namespace diabolo {

namespace diagnose_detail {

/// A horizon that a stretch reaches while the diabolo is seen.
struct Reached {
  std::size_t horizon;  ///< its number
  Eigen::Index row;     ///< of the stretch
  double time;          ///< since its start [s]
};

inline std::vector<Reached> reached_horizons(const TakeToPlay& take, const Stretch& stretch,
                                             const std::vector<double>& horizons) {
  const Eigen::VectorXd times = row_times(take, stretch);
  std::vector<Reached> reached;
  for (std::size_t h = 0; h < horizons.size(); ++h) {
    Eigen::Index row = 0;
    const double off = (times.array() - horizons[h]).abs().minCoeff(&row);
    if (off <= 0.5 / take.recording.rate + kSameInstant && take.recording.diabolo.valid[stretch.first + row])
      reached.push_back({h, row, times[row]});
  }
  return reached;
}

/// Where a model puts the diabolo at these times, from the start as it is seen: the simulator begins there,
/// too, and what rings by it does so in both.
inline std::vector<Vector3<double>> positions_at(const Model& model, const Recording& recording,
                                                 const State<double>& start, const TipMotion<double>& tips,
                                                 const std::vector<Reached>& reached) {
  std::vector<Vector3<double>> result(reached.size(), Vector3<double>::Constant(kNaN));
  if (reached.empty()) return result;
  const Steps steps{0.0, kEvaluationStep, steps_until(reached.back().time)};
  rollout(predictor_for(model, recording), start, tips, steps,
          [&](std::size_t step, double, const State<double>& state, const StepStatus<double>&) {
            for (std::size_t i = 0; i < reached.size(); ++i)
              if (steps_until(reached[i].time) == step) result[i] = state.position;
          });
  return result;
}

/// Errors at one horizon [m].
struct SimulatorErrors {
  std::vector<double> alone, corrected, gain;
};

/// Adds what a stretch shows.
inline void add_errors(const TakeToPlay& take, const Stretch& stretch,
                       const std::vector<State<double>>& played, const Model& simulated,
                       std::vector<SimulatorErrors>& errors) {
  const std::vector<Reached> reached = reached_horizons(take, stretch, HeldOut{}.horizons);
  const TipMotion<double> tips = tips_of(take, stretch);
  const auto predicted_by = [&](const Model& model) {
    return positions_at(model, take.recording, stretch.start, tips, reached);
  };
  const std::vector<Vector3<double>> real = predicted_by(take.model), ours = predicted_by(simulated);
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const Vector3<double> seen = take.recording.diabolo.position.col(stretch.first + reached[i].row),
                          theirs = played[static_cast<std::size_t>(reached[i].row)].position;
    const double before = (theirs - seen).norm(), after = (theirs + real[i] - ours[i] - seen).norm();
    if (!std::isfinite(after)) continue;
    SimulatorErrors& at = errors[reached[i].horizon];
    at.alone.push_back(before);
    at.corrected.push_back(after);
    at.gain.push_back(before - after);
  }
}

}  // namespace diagnose_detail

/// What a simulator's predictions are wrong by, alone and with what `real` says beyond `simulated`, the model
/// of what the simulator does. `played` holds the states of each stretch of each take.
inline HeldOutErrors simulator_errors(const std::vector<TakeToPlay>& takes, const Played& played,
                                      const Model& simulated, std::uint64_t seed) {
  const std::vector<double> horizons = HeldOut{}.horizons;
  std::vector<diagnose_detail::SimulatorErrors> errors(horizons.size());
  for (std::size_t t = 0; t < takes.size(); ++t)
    for (std::size_t s = 0; s < takes[t].stretches.size(); ++s)
      diagnose_detail::add_errors(takes[t], takes[t].stretches[s], played[t][s], simulated, errors);
  HeldOutErrors result;
  result.heldout = "stretches";
  result.horizons_s = horizons;
  std::mt19937_64 generator(seed);
  for (const diagnose_detail::SimulatorErrors& at : errors) {
    result.base_error_m.push_back(diagnose_detail::mean_if_any(at.alone));
    result.augmented_error_m.push_back(diagnose_detail::mean_if_any(at.corrected));
    result.start_error_m.emplace_back();
    const std::optional<ErrorSummary> summary = summarize(at.gain, 1, generator);
    result.improvement_ci95_m.push_back(summary ? summary->mean_ci95 : std::nullopt);
    result.windows = std::max(result.windows, at.gain.size());
  }
  return result;
}

}  // namespace diabolo
