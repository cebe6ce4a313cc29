// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/compare_simulator.hpp"
#include "diabolo/diagnose/play_in_simulator.hpp"
#include "diabolo/diagnose/simulator_errors.hpp"

// Any simulator: what it has and what it lacks, found from what it does.
namespace diabolo {

/// Compares recordings with what a simulator made of the same motion of the sticks. `options.holdout` is of
/// the recordings. Throws as diagnose() does.
template <class D = diagnose_detail::FitDual>
SimulatorComparison compare_simulator(const std::vector<Recording>& recordings,
                                      const std::vector<Recording>& simulated, DiagnosisOptions options = {},
                                      const DiagnosisWatch& watch = {}) {
  const Diagnosis real = diagnose<D>(recordings, options, watch);
  options.holdout.clear();
  const Diagnosis theirs = diagnose<D>(simulated, options, watch);
  return compare_simulator<D>(real, theirs, result_of(real, recordings), result_of(theirs, simulated),
                              options.threads, {{}, watch.cancelled});
}

/// The same of a simulator that can be asked: it plays stretches from recorded starts, and its errors are
/// told with what it lacks and without.
template <class D = diagnose_detail::FitDual>
SimulatorComparison compare_simulator(const std::vector<Recording>& recordings, const Simulate& simulate,
                                      DiagnosisOptions options = {}, const DiagnosisWatch& watch = {}) {
  const Diagnosis real = diagnose<D>(recordings, options, watch);
  const std::vector<TakeToPlay> takes = takes_to_play(real, options.holdout);
  const Played played = play(takes, simulate);
  const std::vector<Recording> simulated = played_takes(takes, played);
  options.holdout.clear();
  options.axle = knows_axle(played);
  const Diagnosis theirs = simulated.empty() ? nothing_played() : diagnose<D>(simulated, options, watch);
  SimulatorComparison result =
      compare_simulator<D>(real, theirs, result_of(real, recordings), result_of(theirs, simulated),
                           options.threads, {{}, watch.cancelled});
  if (!takes.empty()) result.fit = simulator_errors(takes, played, theirs.model, options.seed);
  return result;
}

}  // namespace diabolo
