// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>

#include "diabolo/estimate/camera_update.hpp"
#include "diabolo/estimate/process_models.hpp"
#include "diabolo/estimate/pull_update.hpp"

namespace diabolo {

/// A step of an estimator: from what, how the tips moved, and all that was measured of its end.
template <bool kAxle>
struct Tick {
  Belief<kAxle> before, after;
  Tips<double> begin, end;
  double dt = 0.0;  ///< [s]; zero: no step, what was known at the beginning
  PullMeasurement pulls;
  std::optional<CameraMeasurement> camera = std::nullopt;
};

/// What predictor and measurements make of a tick.
template <bool kAxle, template <class> class... Effects>
class TickFilter {
 public:
  TickFilter(const Predictor<double, Effects...>& predictor, const ProcessNoise& noise)
      : predictor_(predictor), noise_(noise) {
    noise.validate();
  }

  const Predictor<double, Effects...>& predictor() const { return predictor_; }

  /// From `before` to `after`: a step, then pulls, then the camera. The result does not depend on when these
  /// became known. Never allocates.
  void run(Tick<kAxle>& tick) const {
    tick.after = tick.before;
    if (tick.dt > 0.0) advance(tick);
    if (tick.camera) camera_update(predictor_, *tick.camera, tick.end, tick.after);
  }

 private:
  /// After a tension that fails the gate the measured ones move the diabolo, until so many steps had none.
  static constexpr int kGatedSteps = 5;

  void advance(Tick<kAxle>& tick) const {
    Belief<kAxle>& now = tick.after;
    const bool reads = tick.pulls.index() != 0;
    const State<double>& from = tick.before.state;
    const PulledStep step{
        tick.begin, tick.end, tick.dt,
        strand_pulls(tick.pulls, pulling_strands(predictor_, from, from, tick.begin, tick.end))};
    Passage<kAxle> passage = pass_on_string(predictor_, step, tick.before);
    const bool fails = reads && fails_gate(noise_, passage, step.read);
    now.gated = fails ? kGatedSteps : std::max(0, tick.before.gated - 1);
    if (reads && now.gated > 0) passage = pass_by_tensions(predictor_, step, tick.before);
    now.time = tick.before.time + tick.dt;
    now.string_weights = passage.string_weights;
    now.pulled = passage.pulled > 0.5;
    now.normalized_innovation_squared = 0.0;
    now.state = StateChart<kAxle>::at(passage.centre, Passage<kAxle>::Points::deviate(passage.places));
    now.state.string_state =
        static_cast<StringState>(std::ranges::max_element(now.string_weights) - now.string_weights.begin());
    StepDeviations<kAxle> spread;
    spread << passage.places, passage_noise<kAxle>(noise_, passage, tick.end, tick.dt);
    if (reads)
      pull_update(noise_, step.read, passage, spread, now);
    else
      now.factor = lower_factor<Belief<kAxle>::kSize, StepDeviations<kAxle>::ColsAtCompileTime>(spread);
  }

  Predictor<double, Effects...> predictor_;
  ProcessNoise noise_;
};

}  // namespace diabolo
