// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "diabolo/estimate/tick_history.hpp"

namespace diabolo {

/// Estimates position, velocity, spin and, with `kAxle`, the axle's direction of the diabolo, from the tips'
/// motion and from any of: pulls on the tips, looks of a camera. A square-root unscented Kalman filter whose
/// process is the predictor.
///
///     Estimator<false> estimator(predictor, {}, start, {}, tips, 0.0, 250);
///     estimator.step(tips_now, 0.002);
///     estimator.take(ForceReading{...});
///     estimator.take(CameraLook{.time = seen, .position = ...});  // late: goes back, and forth again
///     estimator.now().state
///
/// The order in which measurements arrive does not change the result. Allocates in its constructor alone.
template <bool kAxle, template <class> class... Effects>
class Estimator {
 public:
  /// From what is known at `time` [s]: a state, how sure it is, and where the tips are. `history` counts the
  /// steps that a late measurement may go back. The predictor's string must not stretch, nor its sticks bend:
  /// such bounces are faster than what an estimate follows. Throws std::invalid_argument naming the field.
  Estimator(const Predictor<double, Effects...>& predictor, const ProcessNoise& noise,
            const State<double>& start, const Spread& spread, const Tips<double>& tips, double time,
            std::size_t history)
      : filter_(predictor, noise), ticks_(history, Belief<kAxle>::begin(time, start, spread), tips) {
    spread.validate();
    estimate_detail::expect_finite("start, time", std::isfinite(time));
    estimate_detail::expect_finite("start", is_finite(start));
    if (!(std::abs(start.axis.norm() - 1.0) < 1e-6))
      throw std::invalid_argument("start, axis: norm " + shown(start.axis.norm()) +
                                  "; expected a unit vector");
    expect_tips("start", tips);
    refuse_spring(predictor, start, tips);
  }

  const Predictor<double, Effects...>& predictor() const { return filter_.predictor(); }
  const Belief<kAxle>& now() const { return ticks_[0].after; }
  /// What is known by now of the end of the step `ago` steps before the last one. Throws
  /// std::invalid_argument beyond history().
  const Belief<kAxle>& past(std::size_t ago) const {
    if (ago > history())
      throw std::invalid_argument("past, ago: " + std::to_string(ago) + " steps; expected at most " +
                                  std::to_string(history()));
    return ticks_[ago].after;
  }
  std::size_t history() const { return ticks_.steps(); }

  /// The tips have moved on to `tips` in `dt` > 0 [s], a second at most. Throws std::invalid_argument where
  /// that is not so.
  void step(const Tips<double>& tips, double dt) {
    expect_positive("step, dt", dt, kLongestStep);
    expect_tips("step", tips);
    filter_.run(ticks_.add(tips, dt));
  }

  /// Pulls at the end of the last step.
  Taken take(const ForceReading& reading) { return take_pulls(reading, now().time); }
  Taken take(const TensionReading& reading) { return take_pulls(reading, now().time); }
  /// Pulls that come late: `time` [s] is that of the step's end, within half a step.
  Taken take(const ForceReading& reading, double time) { return take_pulls(reading, time); }
  Taken take(const TensionReading& reading, double time) { return take_pulls(reading, time); }

  /// A look, however late within the history.
  Taken take(const CameraLook& look) {
    validate(look);
    std::size_t ago = 0;
    const Taken found = ticks_.find(look.time, ago);
    if (found != Taken::kYes) return found;
    if (ticks_[ago].look) return Taken::kOccupied;
    ticks_[ago].look = look;
    replay(ago);
    return Taken::kYes;
  }

 private:
  static constexpr double kLongestStep = 1.0;  // [s]

  static void expect_tips(const char* what, const Tips<double>& tips) {
    estimate_detail::expect_within(what, "tips", tips.left, 1e4);
    estimate_detail::expect_within(what, "tips", tips.right, 1e4);
    estimate_detail::expect_within(what, "tips' velocities", tips.left_velocity, 1e4);
    estimate_detail::expect_within(what, "tips' velocities", tips.right_velocity, 1e4);
  }

  template <class Reading>
  Taken take_pulls(const Reading& reading, double time) {
    validate(reading);
    estimate_detail::expect_finite("pulls, time", std::isfinite(time));
    std::size_t ago = 0;
    const Taken found = ticks_.find(time, ago);
    if (found != Taken::kYes) return found;
    if (!(ticks_[ago].dt > 0.0)) return Taken::kTooOld;  // no step ends there
    if (ticks_[ago].pulls.index() != 0) return Taken::kOccupied;
    ticks_[ago].pulls = reading;
    replay(ago);
    return Taken::kYes;
  }

  /// All steps from one on, anew.
  void replay(std::size_t ago) {
    filter_.run(ticks_[ago]);
    while (ago-- > 0) {
      ticks_[ago].before = ticks_[ago + 1].after;
      filter_.run(ticks_[ago]);
    }
  }

  static void refuse_spring(const Predictor<double, Effects...>& predictor, State<double> start,
                            const Tips<double>& tips) {
    const auto& effects = predictor.effects();
    const auto& parameters = predictor.parameters();
    const double compliance =
        effects.string_at(effects.string(parameters), start, tips, parameters).compliance;
    if (compliance != 0.0)
      throw std::invalid_argument("estimator, string: compliance " + shown(compliance / parameters.mass) +
                                  " m/N; expected a model without string_elasticity and stick_flex");
    if (parameters.follow_turns)
      throw std::invalid_argument(
          "estimator, follow_turns: true; expected a string whose turns do not change");
    if (parameters.string_law != StringLaw::kInextensible)
      throw std::invalid_argument("estimator, string_law: pull_velocity; expected inextensible");
  }

  TickFilter<kAxle, Effects...> filter_;
  TickHistory<kAxle> ticks_;
};

}  // namespace diabolo
