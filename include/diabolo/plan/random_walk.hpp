// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "diabolo/plan/plan.hpp"

namespace diabolo {

/// The paper's search: from the best motion so far, which is the seed at first, each knot moves by up to a
/// centimetre in each coordinate and the whole motion becomes up to 50 ms longer or shorter, its interior
/// times drawn anew; what is better and keeps the limits is kept. It stays within Freedom::reach of the kept
/// seed, but draws times as the paper does, whatever Freedom::stretch says.
struct RandomWalk {
  double knot_step = 0.01;  ///< [m]
  double time_step = 0.05;  ///< of the whole motion [s]
  double least_gap = 0.25;  ///< between two times, where the motion has room for it [s]

  /// Random numbers come from the generator alone; the same one in the same state gives the same plan.
  template <template <class> class... Effects, class Generator>
  Plan operator()(const PlanProblem<Effects...>& problem, const Budget& budget, Generator& generator) const {
    problem.validate();
    const StickSpline<double> seed = kept_seed(problem.seed, problem.limits, problem.string_length());
    StickSpline<double> best = seed;
    double least = problem.cost(path_of(best), problem.dt, false);
    int evaluations = 1;
    while (!budget.spent(evaluations)) {
      const StickSpline<double> tried = moved(best, seed, problem.freedom, generator);
      ++evaluations;
      const TipPath<double> path = path_of(tried);
      if (!keeps(path, problem.limits, problem.string_length())) continue;
      const double cost = problem.cost(path, problem.dt, false);
      if (!(cost < least)) continue;
      least = cost;
      best = tried;
    }
    return found(judged(problem, best, evaluations,
                        {limit_uses(path_of(problem.seed), problem.limits, problem.string_length())}));
  }

 private:
  /// Evenly within [low, high), the same on every machine.
  template <class Generator>
  static double uniform(Generator& generator, double low, double high) {
    static_assert(Generator::max() - Generator::min() >= 0xffffffffU, "expected 32 random bits at least");
    const auto bits = static_cast<std::uint32_t>(generator() - Generator::min());
    return low + (high - low) * (static_cast<double>(bits) * 0x1p-32);
  }

  template <class Generator>
  StickSpline<double> moved(StickSpline<double> motion, const StickSpline<double>& seed,
                            const Freedom& freedom, Generator& generator) const {
    const bool last = freedom.last_point && motion.ends == SplineEnds::kClamped;
    for (std::size_t i = 1; i + (last ? 0 : 1) < motion.points.size(); ++i)
      for (int k = 0; k < 6; ++k)
        if (k % 3 != 0 || freedom.forward) {
          const double from = seed.points[i][k],
                       to = motion.points[i][k] + uniform(generator, -knot_step, knot_step);
          motion.points[i][k] = std::clamp(to, from - freedom.reach, from + freedom.reach);
        }
    if (!freedom.times) return motion;
    const double before = motion.end() - motion.begin;
    const double whole = std::max(0.5 * before, before + uniform(generator, -time_step, time_step));
    const std::size_t n = motion.durations.size();
    const double gap = std::min(least_gap, 0.5 * whole / static_cast<double>(n));
    // Interior times, evenly drawn among all that keep the gap: sorted numbers with the gaps put between.
    std::vector<double> times(n - 1);
    for (double& time : times) time = uniform(generator, 0.0, whole - gap * static_cast<double>(n));
    std::ranges::sort(times);
    double previous = 0.0;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      motion.durations[i] = times[i] - previous + gap;
      previous = times[i];
    }
    motion.durations[n - 1] = whole - gap * static_cast<double>(n - 1) - previous;
    return motion;
  }
};

}  // namespace diabolo
