// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diabolo/recording/baseline.hpp"
#include "diabolo/recording/dropouts.hpp"
#include "diabolo/recording/evaluation_step.hpp"
#include "diabolo/recording/horizon_options.hpp"
#include "diabolo/recording/model.hpp"
#include "diabolo/recording/start_state.hpp"
#include "diabolo/recording/tip_motion.hpp"
#include "diabolo/recording/windows.hpp"
#include "diabolo/rollout.hpp"

namespace diabolo {

/// Error of one prediction at one horizon.
struct WindowError {
  bool comparable = false;  ///< the recording can tell; else nothing below counts
  bool failed = false;      ///< the prediction diverged before; then `model` does not count
  bool missed_catch = false;
  double model = 0.0, baseline = 0.0;  ///< distance to the recorded diabolo [m]
};

/// What the predictions over one recording need, made once.
class HorizonTask {
 public:
  /// Throws RecordingError, or std::invalid_argument where a parameter of the model is out of its range.
  HorizonTask(const Recording& recording, const Model& model, const HorizonOptions& options)
      : recording_(without_dropout_edges(recording)),
        tips_(recording, model.interpolation),
        starts_(recording_, has_signed_spin(model)),
        baseline_(baseline_track(recording)),
        predictor_(predictor_for(model, recording)),
        windows_(
            prediction_windows(recording_, starts_, tips_.times(), options.starts_every, options.horizons)),
        start_(options.start) {}

  std::size_t size() const { return windows_.size(); }

  /// The errors at each horizon of the prediction from start number `index`.
  std::vector<WindowError> errors(std::size_t index) const {
    const PredictionWindow& window = windows_[index];
    const Eigen::VectorXd& times = tips_.times();
    const double begin = times[window.start];
    const State<double> start = starts_.at(start_, window.start);
    const auto motion = tips_.motion(window.start, window.last);
    std::vector<WindowError> errors(window.rows.size());
    bool in_world = true;
    State<double> before = start;
    const Steps steps{begin, kEvaluationStep, steps_until(times[window.last] - begin)};
    rollout(predictor_, start, *motion, steps,
            [&](std::size_t step, double, const State<double>& state, const StepStatus<double>&) {
              in_world = in_world && is_in_world(state.position);
              for (std::size_t h = 0; h < errors.size(); ++h) {
                if (!window.rows[h]) continue;
                const Eigen::Index row = *window.rows[h];
                const double elapsed = times[row] - begin;
                if (steps_until(elapsed) != step) continue;
                errors[h] =
                    compare(row, before, state, elapsed / kEvaluationStep - static_cast<double>(step) + 1.0);
                errors[h].failed = !in_world;
              }
              before = state;
            });
    return errors;
  }

 private:
  /// Compares the prediction at a row `fraction` of the way between two steps.
  WindowError compare(Eigen::Index row, const State<double>& before, const State<double>& after,
                      double fraction) const {
    const Vector3<double> recorded = recording_.diabolo.position.col(row);
    const Vector3<double> predicted = before.position + (after.position - before.position) * fraction;
    const Vector3<double> left = recording_.left.position.col(row),
                          right = recording_.right.position.col(row);
    WindowError error;
    error.comparable = true;
    error.model = (predicted - recorded).norm();
    error.baseline = (baseline_.position.col(row) - recorded).norm();
    error.missed_catch = after.string_state == StringState::kFlying && recording_.left.valid[row] &&
                         recording_.right.valid[row] && height_above_tips(predicted, left, right) < 0.0;
    return error;
  }

  Recording recording_;
  RecordedTips tips_;
  StartStates starts_;
  Track baseline_;
  FullPredictor<double> predictor_;
  std::vector<PredictionWindow> windows_;
  Start start_;
};

}  // namespace diabolo
