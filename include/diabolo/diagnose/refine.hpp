// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "diabolo/diagnose/fit.hpp"
#include "diabolo/diagnose/fitted_spring.hpp"
#include "diabolo/diagnose/time_budget.hpp"

namespace diabolo {

/// Tries at a step, each shorter than the one before.
inline constexpr int kMostAttempts = 5;

/// Of a fit, which ends sooner where it has settled.
inline constexpr int kMostIterations = 8;

/// The noise is estimated again in the first three iterations, and on until it is what the middle window
/// leaves within this share: a fit that is still far off makes it too large.
inline constexpr double kNoiseSettled = 0.2;

/// A step that promises less of the cost than this times the dispersion, and leads uphill all the same, is
/// not tried any shorter: a deviation of a tenth would cost as much.
inline constexpr double kNothingToGain = 0.01;

/// What a step takes off the cost by its quadratic model, and, while the starts still move, what that takes
/// off chi^2.
inline double promise(const Fit& fit, const Normal& normal, const Eigen::VectorXd& step) {
  double result = 2.0 * normal.score.dot(step) - step.dot(normal.information * step);
  for (const WindowScore& window : fit.scores) result += window.weight * window.start_gain;
  return result;
}

/// Moves the windows' starts from where `from` has them along with a scaled step of the unknowns.
inline void move_starts(Fit& fit, const Fit& from, const UnknownVector& scaled_step, double damping) {
  std::size_t i = 0;
  for (std::size_t s = 0; s < fit.fit_takes.size(); ++s)
    for (std::size_t w = 0; w < fit.fit_takes[s].windows.size(); ++w, ++i) {
      const WindowScore& score = from.scores[i];
      const Eigen::Matrix<double, kStartUnknowns, 1> move =
          score.start_step / (1.0 + damping) - score.start_by_unknowns * scaled_step;
      State<double> start = from.fit_takes[s].windows[w].start;
      for (int c = 0; c < 3; ++c) {
        start.position[c] += kStartScales[c] * std::clamp(move[c], -10.0, 10.0);
        start.velocity[c] += kStartScales[3 + c] * std::clamp(move[3 + c], -30.0, 30.0);
      }
      start.spin += kStartScales[6] * move[6];
      fit.fit_takes[s].windows[w].start = start;
    }
}

/// A copy that takes along what the next look at the windows makes anew.
inline Fit put_aside(Fit& fit) {
  std::vector<WindowSystem> systems = std::move(fit.systems);
  std::vector<WindowScore> scores = std::move(fit.scores);
  Fit result = fit;
  result.systems = std::move(systems);
  result.scores = std::move(scores);
  return result;
}

/// Gauss and Newton's method on the active unknowns and all starts, from a `fit` that was looked at with
/// them, damped where a step leads uphill. Once one has, the next are looked at by their starts alone, which
/// is enough for their cost; the one that does not is looked at again. It ends early where the watch has
/// enough.
template <class D>
void descend(Fit& fit, const Model& base, const ActiveSet& active, int most_iterations, int threads,
             const FitWatch& watch) {
  double damping = 0.0;
  for (int iteration = 0; iteration < most_iterations && !watch.is_enough(); ++iteration) {
    ++fit.iterations;
    const Normal normal = normal_equations(fit, active);
    Fit best = put_aside(fit);
    const bool noise_is_known =
        fit.noise_is_known || (iteration >= 3 && std::abs(fit.usual - 1.0) < kNoiseSettled);
    bool found = false;
    double largest = 0.0;
    for (int attempt = 0; attempt < kMostAttempts && !found; ++attempt) {
      if (attempt > 0) damping = std::max(0.1, 10.0 * damping);
      const Eigen::VectorXd step =
          bounded_step(normal, best.at, diagnose_detail::least_values(best.at, best.centre), damping);
      UnknownVector scaled_step = UnknownVector::Zero();
      scaled_step(normal.free) = step;
      fit.at = best.at + scaled_step.cwiseProduct(scales());
      largest = step.cwiseProduct(normal.information.diagonal().cwiseSqrt()).lpNorm<Eigen::Infinity>();
      move_starts(fit, best, scaled_step, damping);
      const bool doubtful = attempt > 0 && active.any();
      const auto downhill = [&](const ActiveSet& carried) {
        linearize<D>(fit, base, carried, threads, watch);
        return fit.cost <= best.cost * (1.0 + 1e-9);
      };
      found = (!doubtful || downhill(ActiveSet::Constant(false))) && downhill(active);
      if (!found && promise(best, normal, step) < kNothingToGain * best.dispersion) break;
    }
    damping = damping > 0.01 && found ? 0.1 * damping : 0.0;
    const bool settled = !found || best.cost - fit.cost < 1e-4 * (1.0 + fit.cost) || largest < 0.02;
    const std::vector<CameraNoise> noise = best.noise;
    if (!found) fit = std::move(best);
    if (!noise_is_known) update_noise(fit);  // what stands in the way may be that it is wrong
    if (settled && (noise_is_known || fit.noise == noise)) return;
    if (!noise_is_known) reweight(fit, threads);
  }
}

/// The same from wherever `fit` is.
template <class D>
void approach(Fit& fit, const Model& base, const ActiveSet& active, int most_iterations, int threads,
              const FitWatch& watch = {}) {
  linearize<D>(fit, base, active, threads, watch);
  descend<D>(fit, base, active, most_iterations, threads, watch);
}

/// Other recordings where a fit is: each window's start is fitted, nothing else.
template <class D>
Fit fit_starts(const std::vector<Recording>& recordings, const Fit& fit, const Model& base, int threads,
               const FitWatch& watch) {
  Fit result;
  result.at = fit.at;
  result.centre = fit.centre;
  result.delay = fit.delay;
  result.bounces = fit.bounces;
  for (const Recording& recording : recordings) {
    result.fit_takes.push_back(make_fit_take(recording));
    result.noise.emplace_back();
  }
  if (window_count(result.fit_takes) > 0)
    approach<D>(result, base, ActiveSet::Constant(false), 3, threads, watch);
  return result;
}

/// As approach(), and a last look with derivatives by all unknowns.
template <class D = diagnose_detail::FitDual>
void refine(Fit& fit, const Model& base, const ActiveSet& active, int most_iterations, int threads,
            const FitWatch& watch = {}) {
  approach<D>(fit, base, active, most_iterations, threads, watch);
  linearize<D>(fit, base, threads, watch);
}

}  // namespace diabolo
