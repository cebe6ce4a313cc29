// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "diabolo/estimate/estimator_checks.hpp"
#include "diabolo/estimate/tick_history.hpp"

namespace diabolo {

/// Estimates position, velocity, spin and, with `kAxle`, the axle's direction of the diabolo, from the tips'
/// motion and from any of: pulls on the tips, a camera. A square-root unscented Kalman filter whose
/// process is the predictor.
///
///     Estimator<false> estimator(predictor, {}, start, {}, tips, 0.0, 250);
///     estimator.step(tips_now, 0.002);
///     estimator.update(ForceMeasurement{...});
///     estimator.update(CameraMeasurement{.time = seen, .position = ...});  // late: goes back, and forth
///     again estimator.now().state
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
    estimate_detail::check_start(start, tips, time);
    estimate_detail::refuse_spring(predictor, start, tips);
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
    estimate_detail::expect_tips("step", tips);
    filter_.run(ticks_.add(tips, dt));
  }

  /// Pulls at the end of the last step.
  MeasurementStatus update(const ForceMeasurement& reading) { return update_by_pulls(reading, now().time); }
  MeasurementStatus update(const TensionMeasurement& reading) { return update_by_pulls(reading, now().time); }
  /// Pulls that come late: `time` [s] is that of the step's end, within half a step.
  MeasurementStatus update(const ForceMeasurement& reading, double time) {
    return update_by_pulls(reading, time);
  }
  MeasurementStatus update(const TensionMeasurement& reading, double time) {
    return update_by_pulls(reading, time);
  }

  /// Of a camera, however late within the history.
  MeasurementStatus update(const CameraMeasurement& measured) {
    validate(measured);
    std::size_t ago = 0;
    const MeasurementStatus found = ticks_.find(measured.time, ago);
    if (found != MeasurementStatus::kAccepted) return found;
    if (ticks_[ago].camera) return MeasurementStatus::kDuplicate;
    ticks_[ago].camera = measured;
    replay(ago);
    return MeasurementStatus::kAccepted;
  }

 private:
  static constexpr double kLongestStep = 1.0;  // [s]

  template <class Reading>
  MeasurementStatus update_by_pulls(const Reading& reading, double time) {
    validate(reading);
    estimate_detail::expect_finite("pulls, time", std::isfinite(time));
    std::size_t ago = 0;
    const MeasurementStatus found = ticks_.find(time, ago);
    if (found != MeasurementStatus::kAccepted) return found;
    if (!(ticks_[ago].dt > 0.0)) return MeasurementStatus::kTooOld;  // no step ends there
    if (ticks_[ago].pulls.index() != 0) return MeasurementStatus::kDuplicate;
    ticks_[ago].pulls = reading;
    replay(ago);
    return MeasurementStatus::kAccepted;
  }

  /// All steps from one on, anew.
  void replay(std::size_t ago) {
    filter_.run(ticks_[ago]);
    while (ago-- > 0) {
      ticks_[ago].before = ticks_[ago + 1].after;
      filter_.run(ticks_[ago]);
    }
  }

  TickFilter<kAxle, Effects...> filter_;
  TickHistory<kAxle> ticks_;
};

}  // namespace diabolo
