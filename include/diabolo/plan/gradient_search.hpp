// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/math/dual.hpp"
#include "diabolo/math/least_squares.hpp"
#include "diabolo/plan/plan.hpp"

namespace diabolo {

/// Follows the derivatives: Levenberg and Marquardt's method on smooth residuals, whose derivatives by all
/// control points and times flow, as dual numbers, through spline, prediction and its events. Limits enter as
/// residuals that grow beyond them; if the end still breaks one, the motion goes back towards the best one
/// that keeps them, so far as it must.
struct GradientSearch {
  int iterations = 30;        ///< each a prediction with derivatives
  double least_gain = 2e-3;   ///< an iteration that gains a smaller share of the residual ends the search
  double good_enough = 2e-6;  ///< so does a smaller sum of squared residuals,
  double good_share = 0.125;  ///< or every goal within this share of its tolerance, far from the limits

  /// Other paces of the seed, tried in turn while a goal is missed.
  std::vector<double> other_paces{1.15, 0.87};

  template <template <class> class... Effects>
  Plan operator()(const PlanProblem<Effects...>& problem, const Budget& budget) const {
    problem.validate();
    const std::size_t size = MotionUnknowns(problem.seed, problem.freedom).size();
    return size <= kFew ? search<kFew>(problem, budget) : search<kChunk>(problem, budget);
  }

 private:
  static constexpr int kFew = 20, kChunk = 28;  ///< derivatives carried along at once
  template <int N>
  using D = Dual<double, N, float>;

  template <int N, template <class> class... Effects>
  Plan search(const PlanProblem<Effects...>& problem, const Budget& budget) const {
    std::vector<Predictor<D<N>, Effects...>> duals;
    for (const auto& model : problem.models) duals.push_back(predictor_in<D<N>>(model));
    int evaluations = 0;
    Plan best = from<N>(problem, duals, problem.seed, budget, evaluations);
    for (const double pace : other_paces) {
      if (best.reached || budget.spent(evaluations)) break;
      StickSpline<double> seed = problem.seed;
      for (double& duration : seed.durations) duration /= pace;
      Plan other = from<N>(problem, duals, seed, budget, evaluations);
      if (other.reached || other.cost < best.cost) best = std::move(other);
    }
    best.evaluations = evaluations;
    return found(std::move(best));
  }

  template <int N, template <class> class... Effects>
  Plan from(const PlanProblem<Effects...>& problem, const std::vector<Predictor<D<N>, Effects...>>& duals,
            const StickSpline<double>& wanted_seed, const Budget& budget, int& evaluations) const {
    const double length = problem.string_length();
    const StickSpline<double> seed = kept_seed(wanted_seed, problem.limits, length);
    const MotionUnknowns unknowns(seed, problem.freedom);
    PlanResiduals<Effects...> residuals(problem, unknowns);
    std::vector<double> bounds, x(unknowns.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) bounds.push_back(unknowns.bound(i));
    double sum = INFINITY, least = INFINITY, share_off = INFINITY;  // share_off: at the least sum
    const auto value = [&](const std::vector<double>& at) {
      ++evaluations;
      sum = 0.0;
      double worst = INFINITY;
      for (const double part : residuals(problem.models, at, &worst)) sum += part * part;
      if (residuals.others())
        for (const LimitUse& use : residuals.others()(residuals.path(at))) {
          const double part = residuals.other_part(use);
          sum += part * part;
          if (part > 0.0) worst = INFINITY;
        }
      if (sum < least) least = sum, share_off = worst;
      return sum;
    };
    const auto linearize = [&](const std::vector<double>& at) {
      ++evaluations;
      return linearization<N>(residuals, duals, at, budget);
    };
    const auto stop = [&] {
      return budget.spent(evaluations) || sum < good_enough || share_off < good_share;
    };
    residuals.dt = problem.dt;
    least_squares(x, bounds, iterations, 2.0, least_gain, value, linearize, stop);
    // Limits that still give way become harder.
    const auto kept = [&] { return keeps(path_of(unknowns.motion(x)), problem.limits, length); };
    std::vector<std::vector<LimitUse>> wanted{limit_uses(path_of(wanted_seed), problem.limits, length)};
    for (int round = 0; round < 3 && !budget.spent(evaluations) && !kept(); ++round) {
      wanted.push_back(limit_uses(path_of(unknowns.motion(x)), problem.limits, length));
      residuals.weight *= 5.0;
      residuals.inside += 0.01;
      sum = least = share_off = INFINITY;
      least_squares(x, bounds, 6, 0.5, least_gain, value, linearize, stop);
    }
    const StickSpline<double> found = unknowns.motion(x);
    const auto towards = [&](double share) { return plan_detail::between(seed, found, share); };
    const double share = plan_detail::kept_share(problem.limits, length, towards);
    wanted.push_back(limit_uses(path_of(found), problem.limits, length));
    Plan plan = judged(problem, towards(share), evaluations, wanted);
    if (share == 1.0) return plan;
    Plan stayed = judged(problem, seed, evaluations, wanted);
    return stayed.cost < plan.cost ? stayed : plan;
  }

  /// Where the budget's time is spent on the way, what came out until then; the caller looks at the budget.
  template <int N, template <class> class... Effects>
  static Linearization linearization(const PlanResiduals<Effects...>& residuals,
                                     const std::vector<Predictor<D<N>, Effects...>>& models,
                                     const std::vector<double>& x, const Budget& budget) {
    Linearization result;
    for (std::size_t first = 0; first < x.size(); first += N) {
      if (first > 0 && budget.spent(0)) return result;  // zeros where it did not come to
      const std::size_t count = std::min<std::size_t>(N, x.size() - first);
      std::vector<D<N>> at(x.begin(), x.end());
      for (std::size_t i = 0; i < count; ++i)
        at[first + i] = D<N>::variable(x[first + i], static_cast<int>(i));
      const std::vector<D<N>> parts = residuals(models, at);
      const Eigen::Index rows = static_cast<Eigen::Index>(parts.size()),
                         columns = static_cast<Eigen::Index>(x.size());
      if (first == 0) {
        result.residuals.resize(rows);
        result.jacobian.setZero(rows, columns);
      }
      for (Eigen::Index r = 0; r < rows; ++r) {
        const D<N>& part = parts[static_cast<std::size_t>(r)];
        result.residuals[r] = part.value;
        for (std::size_t i = 0; i < count; ++i)
          result.jacobian(r, static_cast<Eigen::Index>(first + i)) =
              static_cast<double>(part.gradient[static_cast<Eigen::Index>(i)]);
      }
    }
    add_others(residuals, x, budget, result);
    return result;
  }

  /// Rows for the limits that know no derivatives, by central differences.
  template <class Residuals>
  static void add_others(const Residuals& residuals, const std::vector<double>& x, const Budget& budget,
                         Linearization& result) {
    if (!residuals.others()) return;
    const TipPath<double> path = residuals.path(x);
    const std::vector<LimitUse> uses = residuals.others()(path);
    const Eigen::Index first = result.residuals.size(), count = static_cast<Eigen::Index>(uses.size());
    result.residuals.conservativeResize(first + count);
    for (Eigen::Index r = 0; r < count; ++r)
      result.residuals[first + r] = residuals.other_part(uses[static_cast<std::size_t>(r)]);
    result.jacobian.conservativeResize(first + count, Eigen::NoChange);
    result.jacobian.bottomRows(count).setZero();
    constexpr double h = 1e-4;
    for (std::size_t i = 0; i < x.size() && !budget.spent(0); ++i) {
      std::vector<double> above = x, below = x;
      above[i] += h;
      below[i] -= h;
      const std::vector<LimitUse> up = residuals.others().near(residuals.path(above), path, uses),
                                  down = residuals.others().near(residuals.path(below), path, uses);
      if (up.size() != uses.size() || down.size() != uses.size())
        throw std::invalid_argument("limits, others: " + std::to_string(up.size()) + " of them; expected " +
                                    std::to_string(uses.size()) + ", as for another path");
      for (std::size_t r = 0; r < uses.size(); ++r)
        result.jacobian(first + static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(i)) =
            (residuals.other_part(up[r]) - residuals.other_part(down[r])) / (2.0 * h);
    }
  }
};

}  // namespace diabolo
