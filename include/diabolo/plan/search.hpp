// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "diabolo/plan/gradient_search.hpp"
#include "diabolo/plan/random_walk.hpp"

namespace diabolo {

/// How a motion is searched: along derivatives through the prediction, or by the paper's random walk.
enum class Solver { kGradient, kWalk };

/// The solver of that name: gradient or walk. Throws std::invalid_argument.
inline Solver solver_named(const std::string& name) {
  if (name == "gradient") return Solver::kGradient;
  if (name == "walk") return Solver::kWalk;
  throw std::invalid_argument("solver: '" + name + "'; expected gradient or walk");
}

/// How long and by what a motion is searched.
struct SearchOptions {
  Solver solver = Solver::kGradient;
  int evaluations = 100000;           ///< motions that are predicted, at most
  double seconds = 10.0;              ///< at most
  std::uint64_t random_seed = 1;      ///< decides the random numbers of the walk
  double dt = 4e-3;                   ///< longest step [s]
  std::function<bool()> cancelled{};  ///< true ends the search with the best motion so far

  /// From now on. Throws std::invalid_argument where a bound is not positive.
  Budget budget() const {
    constexpr double kLongest = 1e6;  // [s]
    if (!(seconds > 0.0)) throw std::invalid_argument("seconds: " + shown(seconds) + "; must be positive");
    if (evaluations < 1) throw std::invalid_argument("evaluations: must be positive");
    return {evaluations, [end = deadline(std::min(seconds, kLongest)), stop = cancelled] {
              return (stop && stop()) || end();
            }};
  }
};

/// The best motion that is found; `problem.dt` counts. Throws std::invalid_argument about bad input.
template <template <class> class... Effects>
Plan searched(const PlanProblem<Effects...>& problem, const SearchOptions& options) {
  const Budget budget = options.budget();
  if (options.solver == Solver::kGradient) return GradientSearch{}(problem, budget);
  std::mt19937_64 generator(options.random_seed);
  return RandomWalk{}(problem, budget, generator);
}

}  // namespace diabolo
