// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/plan/goal_errors.hpp"
#include "diabolo/plan/limits.hpp"
#include "diabolo/plan/motion_unknowns.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// A motion that is wanted: what there is, what shall be achieved, and what must be kept.
template <template <class> class... Effects>
struct PlanProblem {
  using PlanPredictor = Predictor<double, Effects...>;
  std::vector<PlanPredictor>
      models;                ///< what the diabolo may do: the nominal one first; a plan counts on all of them
  State<double> start;       ///< of the diabolo when the motion begins
  StickSpline<double> seed;  ///< a motion that is known to do something like what is wanted
  Goals goals;
  TipLimits limits{};
  Freedom freedom{};
  double dt = 4e-3;  ///< longest step of the search [s]; what is reported comes from kReportedStep
  std::vector<State<double>> starts{};  ///< one for each model where they begin otherwise than at `start`

  static constexpr double kReportedStep = 1e-3;  ///< [s]
  static constexpr double kFlight = 1.2;         ///< how long a flight is followed [s]
  static constexpr std::size_t kMostPoints = 1000;

  /// The shortest that it may have [m]: the tips of a plan stay within it.
  double string_length() const {
    double shortest = models.front().parameters().string_length;
    for (const PlanPredictor& model : models) shortest = std::min(shortest, model.parameters().string_length);
    return shortest;
  }

  /// A diabolo on the string that is farther from it than this share of its length is somewhere else.
  static constexpr double kOffString = 0.5;
  static constexpr double kLeastGravity = 0.1;  ///< for what is thrown to come down [m/s^2]

  /// Throws std::invalid_argument where something is missing or out of its range.
  void validate() const {
    if (models.empty()) throw std::invalid_argument("plan: no model; at least one expected");
    if (!starts.empty() && starts.size() != models.size())
      throw std::invalid_argument("plan: " + std::to_string(starts.size()) + " start states; expected " +
                                  std::to_string(models.size()) + ", one for each model, or none");
    if (!(dt >= 1e-4 && dt <= 0.02))
      throw std::invalid_argument("plan, dt: " + shown(dt) + " s; must be within 0.0001 and 0.02 s");
    seed.validate();
    for (std::size_t m = 0; m < models.size(); ++m) check_start(m);
    goals.validate();
    for (const PlanPredictor& model : models)
      if (const double gravity = model.parameters().gravity; goals.flies() && !(gravity >= kLeastGravity))
        throw std::invalid_argument("plan: a gravity of " + shown(gravity) + " m/s^2; expected " +
                                    shown(kLeastGravity) + " m/s^2 at least for a throw or a catch");
    limits.validate();
    freedom.validate();
    if (seed.points.size() > kMostPoints)
      throw std::invalid_argument("plan: the seed has " + std::to_string(seed.points.size()) +
                                  " points; expected " + std::to_string(kMostPoints) + " at most");
    double duration = 0.0;
    for (const double part : seed.durations) duration += part;
    if (duration > 60.0)
      throw std::invalid_argument("plan: the seed lasts " + shown(duration) + " s; expected 60 s at most");
  }

  /// Throws std::invalid_argument where the diabolo cannot begin as it is said to.
  void check_start(std::size_t m) const {
    const State<double>& state = start_of(m);
    check_state("plan: the start state", state);
    const TipColumn<double>& tips = seed.points.front();
    const double length = models[m].parameters().string_length,
                 path = (state.position - tips.head<3>()).norm() + (state.position - tips.tail<3>()).norm();
    if (state.string_state == StringState::kFlying || path <= (1.0 + kOffString) * length) return;
    throw std::invalid_argument("plan: the start state is on the string, " + shown(length) +
                                " m long, but from tip to tip by way of the diabolo it is " +
                                shown_rounded(path) + " m");
  }

  const State<double>& start_of(std::size_t m) const { return starts.empty() ? start : starts[m]; }

  /// What a motion leads to with model number `m`, given in this Scalar.
  template <class Scalar>
  Play<Scalar> played(std::size_t m, const Predictor<Scalar, Effects...>& model, const TipPath<Scalar>& path,
                      double longest_step) const {
    return play(model, start_of(m), path, {.dt = longest_step, .flight = goals.throws() ? kFlight : 0.0});
  }

  /// As much of it as the goals look at: up to the apex, or down to where it is to land.
  template <class Scalar>
  Play<Scalar> judged_part(std::size_t m, const Predictor<Scalar, Effects...>& model,
                           const TipPath<Scalar>& path, double longest_step) const {
    PlayOptions options{.dt = longest_step, .flight = goals.throws() ? kFlight : 0.0};
    options.down_to = goals.landing ? goals.landing->position.z() : std::numeric_limits<double>::infinity();
    return play(model, start_of(m), path, options);
  }

  /// The paper's residual of a motion, the mean over all models; infinite where one predicts no numbers.
  double cost(const TipPath<double>& path, double longest_step, bool smooth) const {
    double sum = 0.0;
    for (std::size_t m = 0; m < models.size(); ++m)
      sum += total_cost(
          goal_errors(judged_part(m, models[m], path, longest_step), goals, models[m].parameters(), smooth));
    return std::isfinite(sum) ? sum / static_cast<double>(models.size()) : INFINITY;
  }
};

namespace plan_detail {

/// How much a path goes beyond its limits at the instants of a play and at its points, in parts that grow
/// from zero on: what a solver sees of the limits. `inside` is kept free before each limit, as a share of it
/// or in metres of a tenth of that.
template <class Scalar>
void add_limit_parts(const Play<Scalar>& play, const TipPath<Scalar>& path, const TipLimits& limits,
                     double string_length, double inside, double weight, std::vector<Scalar>& parts) {
  const auto share = [&](const Scalar& value, double limit) {
    const Scalar beyond = value * Scalar(1.0 / limit) - Scalar(1.0 - inside);
    if (beyond > Scalar(0)) parts.push_back(beyond * Scalar(weight));
  };
  const auto length = [&](const Scalar& beyond) {  // [m]
    const Scalar kept = beyond + Scalar(0.1 * inside);
    if (kept > Scalar(0)) parts.push_back(kept * Scalar(10.0 * weight));
  };
  for (std::size_t i = 0; i < play.planned; ++i) {
    const Tips<Scalar>& tips = play.instants[i].tips;
    const Vector3<Scalar> span = tips.left - tips.right;
    length(norm(span) - Scalar(string_length - limits.string_margin));
    length(Scalar(limits.least_gap) - span.y());
    for (const Vector3<Scalar>& velocity : {tips.left_velocity, tips.right_velocity})
      share(norm(velocity), limits.speed);
    for (const Vector3<Scalar>& tip : {tips.left, tips.right})
      for (int k = 0; k < 3; ++k) {
        length(tip[k] - Scalar(limits.highest[k]));
        length(Scalar(limits.lowest[k]) - tip[k]);
      }
  }
  for (const TipPiece<Scalar>& piece : path.pieces())
    for (const bool at_end : {false, true}) {
      const std::array<TipColumn<Scalar>, 4> d = piece.at(at_end ? piece.duration : Scalar(0));
      for (int side = 0; side < 2; ++side) {
        const Vector3<Scalar> acceleration = d[2].template segment<3>(3 * side),
                              jerk = d[3].template segment<3>(3 * side);
        share(norm(acceleration), limits.acceleration);
        if (std::isfinite(limits.jerk)) share(norm(jerk), limits.jerk);
      }
    }
}

}  // namespace plan_detail

/// Residuals of a plan whose squares a solver makes small: goals, limits, and a little of the distance from
/// the seed, which decides between motions that are as good.
template <template <class> class... Effects>
class PlanResiduals {
 public:
  static constexpr double kStayNearSeed = 1e-4;

  PlanResiduals(const PlanProblem<Effects...>& problem, const MotionUnknowns& unknowns)
      : problem_(problem), unknowns_(unknowns) {}

  double inside = 0.01, weight = 3.0;  ///< of the limits
  double dt = 4e-3;                    ///< [s]

  /// `models` are those of the problem in this Scalar. `worst` becomes the goal that is farthest off, as a
  /// share of its tolerance; infinite where one does not hold, or near a limit.
  template <class Scalar>
  std::vector<Scalar> operator()(const std::vector<Predictor<Scalar, Effects...>>& models,
                                 const std::vector<Scalar>& x, double* worst = nullptr) const {
    double farthest = 0.0;
    const TipPath<Scalar> path = path_of(unknowns_.motion(x));
    const double share = 1.0 / std::sqrt(static_cast<double>(models.size()));
    std::vector<Scalar> parts;
    for (std::size_t m = 0; m < models.size(); ++m) {
      const Play<Scalar> play = problem_.judged_part(m, models[m], path, dt);
      const std::vector<GoalError<Scalar>> errors =
          goal_errors(play, problem_.goals, problem_.models[m].parameters(), true);
      for (const GoalError<Scalar>& error : errors) {
        for (const Scalar& part : error.parts) parts.push_back(part * Scalar(error.weight * share));
        if (worst) farthest = std::max(farthest, error.share());
      }
      const std::size_t goals = parts.size();
      if (m == 0)
        plan_detail::add_limit_parts(play, path, problem_.limits, problem_.string_length(), inside, weight,
                                     parts);
      if (parts.size() > goals) farthest = INFINITY;
    }
    if (worst) *worst = farthest;
    for (const Scalar& change : x) parts.push_back(change * Scalar(kStayNearSeed));
    return parts;
  }

  const PathLimits& others() const { return problem_.limits.others; }  ///< which know no derivatives
  TipPath<double> path(const std::vector<double>& x) const { return path_of(unknowns_.motion(x)); }
  /// Of each of them there is one part.
  double other_part(const LimitUse& use) const {
    return weight * std::max(0.0, use.unit == "m" ? 10.0 * use.excess + inside : use.excess + inside);
  }

 private:
  const PlanProblem<Effects...>& problem_;
  const MotionUnknowns& unknowns_;
};

}  // namespace diabolo
