// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "diabolo/diagnose/time_budget.hpp"
#include "diabolo/model.hpp"
#include "diabolo/recording/recording.hpp"

namespace diabolo {

/// How a diagnosis is done.
struct DiagnosisOptions {
  Model base = consistent_model();  ///< the simulator that is asked about
  std::vector<Recording> holdout;   ///< to compare on; else recordings, or blocks, are left out in turn
  std::vector<std::string> bank;    ///< names of the candidates; empty: all but placebos
  std::vector<Law> laws;            ///< of one's own, which are candidates too
  bool axle = true;                 ///< ask what turns the recorded axle
  double budget = 1e9;              ///< it ends about then, and tells what it left [s]
  std::uint64_t seed = 1;           ///< of the bootstrap
  int threads = 0;                  ///< 0: one for every processor; the result is the same
};

/// How a diagnosis is watched: the name of the step, and the fraction done of it all.
struct DiagnosisWatch {
  std::function<void(const std::string&, double)> progress;
  std::function<bool()> cancelled;
  TimeBudget::Clock clock;  ///< that the budget goes by; empty: a steady one
};

}  // namespace diabolo
