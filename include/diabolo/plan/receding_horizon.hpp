// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "diabolo/plan/plan.hpp"

namespace diabolo {

/// Where a new piece of motion sets in: what the tips do there, and what the diabolo is predicted to do.
struct Seam {
  double time = 0.0;          ///< [s]
  TipColumn<double> tips;     ///< [m]
  SplineStart<double> start;  ///< velocity and acceleration of the tips
  TipColumn<double> sticks;   ///< their directions, as in Tips
  State<double> state;        ///< of the diabolo
};

/// Motion of the tips that is planned piece by piece while it is played: each new piece is planned from the
/// predicted end of what can no longer be changed, and joins it with the same position, velocity and
/// acceleration. Every piece ends at rest, so that a plan that comes too late is no harm: the tips come to
/// rest on the old one and stay there.
template <template <class> class... Effects>
class RecedingHorizon {
 public:
  using PlanPredictor = Predictor<double, Effects...>;
  static constexpr double kMargin = 1.3;     ///< planning may take so many times as long as the last time
  static constexpr double kLongest = 600.0;  ///< from an observation to a seam [s]

  /// The tips rest at `tips` from `begin` [s] on, over `state`; `sticks` are their directions throughout.
  /// Throws std::invalid_argument where one of them is not finite, or a direction is none.
  RecedingHorizon(PlanPredictor model, const TipColumn<double>& tips, const State<double>& state,
                  double begin, const TipColumn<double>& sticks = TipColumn<double>::Zero())
      : model_(std::move(model)), sticks_(sticks), observed_(state), observed_time_(begin) {
    check_size("horizon: the time of its begin", begin, kLatest, "s");
    check_size("horizon: the tips", tips.stableNorm(), kFarthest, "m");
    if (!is_direction<double>(sticks.head<3>()) || !is_direction<double>(sticks.tail<3>()))
      throw std::invalid_argument("horizon: a stick's direction is neither a unit vector nor zero");
    path_ = rest(begin, kRest, tips);
    observe(begin, state);
  }

  /// What the tips do: the past, and what is planned. After its end they rest.
  const TipPath<double>& path() const { return path_; }

  /// Takes over a state of the diabolo that was seen at a time [s]; predictions begin with the latest one.
  /// Throws std::invalid_argument where it is not finite, or older than the one before.
  void observe(double time, const State<double>& state) {
    check_state("horizon: the observed state", state);
    check_size("horizon: the time of the observation", time, kLatest, "s");
    if (!(time >= observed_time_))
      throw std::invalid_argument("horizon: a state that was observed before the last one");
    observed_ = state;
    observed_time_ = time;
  }

  /// The seam of a piece that is planned now: as late as planning takes, with a margin, at least.
  Seam seam(double now) const { return seam_at(now + kMargin * planning_time_); }

  /// The seam at a time [s] not before the last observation.
  Seam seam_at(double time) const {
    if (!(time >= observed_time_)) throw std::invalid_argument("horizon: a seam before the last observation");
    if (!(time - observed_time_ <= kLongest))
      throw std::invalid_argument("horizon: a seam more than 600 s after the last observation");
    Seam result;
    result.time = time;
    const double within = std::clamp(time, path_.begin(), path_.end());
    const auto tips = path_.derivatives_at(within);
    result.tips = tips[0];
    result.sticks = sticks_;
    if (time < path_.end()) result.start = {tips[1], tips[2]};
    result.state = observed_;
    const double duration = time - observed_time_;
    const int count = static_cast<int>(std::ceil(duration / PlanProblem<Effects...>::kReportedStep - 1e-9));
    for (int i = 0; i < count; ++i) {
      const double dt = duration / count, begin = observed_time_ + i * dt;
      model_.step(result.state, path_.at(begin), path_.at(begin + dt), dt);
    }
    return result;
  }

  /// Joins a plan that was made from `seam` and is ready `now` [s], having taken `planning_time` [s]. False,
  /// and the old motion goes on, where it comes too late: now, or by what was observed since. Throws
  /// std::invalid_argument where the plan does not begin with the tips and velocities of the seam or not end
  /// at rest, or a time is none.
  bool join(const Seam& seam, const Plan& plan, double now, double planning_time) {
    if (!std::isfinite(now) || !(planning_time >= 0.0 && std::isfinite(planning_time)))
      throw std::invalid_argument("horizon: times of a join must be finite, that of planning not negative");
    const auto first = plan.path.derivatives_at(plan.path.begin());
    if (!(first[0] - seam.tips).isZero(kSameTips) || !(first[1] - seam.start.velocity).isZero(kSameTips))
      throw std::invalid_argument("horizon: the plan does not begin at the seam, or moves otherwise there");
    if (!plan.path.derivatives_at(plan.path.end())[1].isZero(kSameTips))
      throw std::invalid_argument("horizon: the plan does not end at rest");
    planning_time_ = planning_time;
    if (!(seam.time >= path_.begin()))
      throw std::invalid_argument("horizon: a seam at " + shown(seam.time) + " s, before its begin at " +
                                  shown(path_.begin()) + " s");
    if (std::max(now, observed_time_) > seam.time) return false;
    TipPath<double> joined = path_.until(seam.time);
    if (const double gap = seam.time - path_.end(); gap > 1e-12)  // the tips have rested since
      joined.append(rest(path_.end(), gap, seam.tips));
    joined.append(plan.path.begun_at(seam.time));
    path_ = std::move(joined);
    return true;
  }

 private:
  static constexpr double kRest = 1e-3;  ///< of the first piece [s]
  static constexpr double kSameTips = TipPath<double>::kSameTips;

  TipPath<double> rest(double begin, double duration, const TipColumn<double>& tips) const {
    const TipColumn<double> none = TipColumn<double>::Zero();
    const TipPiece<double> piece{begin, duration, {tips, none, none, none}, sticks_};
    return TipPath<double>({piece});
  }

  PlanPredictor model_;
  TipColumn<double> sticks_;
  TipPath<double> path_;
  State<double> observed_;
  double observed_time_;
  double planning_time_ = 0.04;  ///< of the last plan; at first what one usually takes [s]
};

/// A seed that sets in at a seam: moved there in time, its first point the tips, its start their motion.
inline StickSpline<double> joined_at(const Seam& seam, StickSpline<double> seed) {
  seed.begin = seam.time;
  seed.points.front() = seam.tips;
  seed.start = seam.start;
  seed.sticks = seam.sticks;
  return seed;
}

}  // namespace diabolo
