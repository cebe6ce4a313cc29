// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "diabolo/evaluate/baseline.hpp"
#include "diabolo/evaluate/evaluation_step.hpp"
#include "diabolo/evaluate/horizon_options.hpp"
#include "diabolo/evaluate/start_noise.hpp"
#include "diabolo/evaluate/start_on_spring.hpp"
#include "diabolo/evaluate/start_state.hpp"
#include "diabolo/evaluate/windows.hpp"
#include "diabolo/model.hpp"
#include "diabolo/recording/dropouts.hpp"
#include "diabolo/recording/tip_motion.hpp"
#include "diabolo/rollout.hpp"

namespace diabolo {

/// Error of one prediction at one horizon.
struct WindowError {
  bool comparable = false;  ///< the recording can tell; else nothing below counts
  bool failed = false;      ///< the prediction diverged before; then `model` does not count
  bool missed_catch = false;
  double model = 0.0, baseline = 0.0;  ///< distance to the recorded diabolo [m]
  double spin = kNaN;  ///< predicted less recorded, in size [rad/s]; NaN where it was not seen
};

/// How far predictions from equally likely starts are apart, a mean over draws; NaN where the recording
/// cannot tell.
struct StartScatter {
  double position = kNaN;  ///< [m]
  double spin = kNaN;      ///< of the noise of place and velocity alone [rad/s]
};

/// What the predictions over one recording need, made once.
class HorizonTask {
 public:
  /// Throws RecordingError, or std::invalid_argument where a parameter of the model is out of its range.
  HorizonTask(const Recording& recording, const Model& model, const HorizonOptions& options)
      : recording_(without_dropout_edges(recording)),
        tips_(recording, model.interpolation),
        starts_(recording_, has_signed_spin(model), options.unseen_spin),
        baseline_(baseline_track(recording)),
        predictor_(predictor_for(model, recording)),
        on_spring_(predictor_, recording_),
        windows_(
            prediction_windows(recording_, starts_, tips_.times(), options.starts_every, options.horizons)),
        start_(options.start) {}

  std::size_t size() const { return windows_.size(); }

  /// The errors at each horizon of the prediction from start number `index`.
  std::vector<WindowError> errors(std::size_t index) const {
    std::vector<WindowError> errors(windows_[index].rows.size());
    predict(index, starts_.at(start_, windows_[index].start),
            [&](std::size_t h, const Vector3<double>& predicted, const State<double>& after, bool in_world) {
              errors[h] = compare(*windows_[index].rows[h], predicted, after);
              errors[h].failed = !in_world;
            });
    return errors;
  }

  /// By how much the spin of start number `index` is off the recorded ones around it [rad/s]; NaN where none
  /// is seen.
  double spin_noise(std::size_t index) const { return starts_.spin_noise(windows_[index].start); }

  /// How far the predictions at each horizon are from each other that begin as start number `index` does and
  /// as it might have: the mean over some draws of a start with this noise.
  std::vector<StartScatter> scatter(std::size_t index, const StartNoise& noise, std::uint64_t seed) const {
    constexpr int kDraws = 4;
    const State<double> start = starts_.at(start_, windows_[index].start);
    struct Predicted {
      Vector3<double> position = Vector3<double>::Zero();
      double spin = 0.0;
    };
    std::vector<Predicted> nominal(windows_[index].rows.size());
    std::vector<StartScatter> apart(nominal.size());
    predict(index, start, [&](std::size_t h, const auto& position, const State<double>& after, bool) {
      nominal[h] = {position, after.spin};
      apart[h] = {0.0, 0.0};
    });
    std::mt19937_64 generator(seed + index);
    for (int draw = 0; draw < kDraws; ++draw)
      predict(index, drawn_start(start, noise, generator),
              [&](std::size_t h, const auto& position, const State<double>& after, bool) {
                apart[h].position += (position - nominal[h].position).norm() / kDraws;
                apart[h].spin += std::abs(after.spin - nominal[h].spin) / kDraws;
              });
    return apart;
  }

 private:
  /// Calls `visit(h, position, state after it, whether it stayed in this world)` at each comparable horizon
  /// `h` of the prediction of a window from a start.
  template <class Visit>
  void predict(std::size_t index, State<double> start, Visit&& visit) const {
    const PredictionWindow& window = windows_[index];
    const Eigen::VectorXd& times = tips_.times();
    const double begin = times[window.start];
    const auto motion = tips_.motion(window.start, window.last);
    on_spring_.place(start, predictor_, *motion, begin, kEvaluationStep);
    bool in_world = true;
    State<double> before = start;
    const Steps steps{begin, kEvaluationStep, steps_until(times[window.last] - begin)};
    rollout(predictor_, start, *motion, steps,
            [&](std::size_t step, double, const State<double>& state, const StepStatus<double>&) {
              in_world = in_world && is_in_world(state.position);
              for (std::size_t h = 0; h < window.rows.size(); ++h) {
                if (!window.rows[h]) continue;
                const double elapsed = times[*window.rows[h]] - begin;
                if (steps_until(elapsed) != step) continue;
                const double fraction = elapsed / kEvaluationStep - static_cast<double>(step) + 1.0;
                const Vector3<double> there = before.position + (state.position - before.position) * fraction;
                visit(h, there, state, in_world);
              }
              before = state;
            });
  }

  /// Compares a predicted position with a row; `after` is the state of the step that ends behind it.
  WindowError compare(Eigen::Index row, const Vector3<double>& predicted, const State<double>& after) const {
    const Vector3<double> recorded = recording_.diabolo.position.col(row);
    const Vector3<double> left = recording_.left.position.col(row),
                          right = recording_.right.position.col(row);
    WindowError error;
    error.comparable = true;
    error.model = (predicted - recorded).norm();
    error.baseline = (baseline_.position.col(row) - recorded).norm();
    error.spin = std::abs(after.spin - starts_.spin_around(row));
    error.missed_catch = after.string_state == StringState::kFlying && recording_.left.valid[row] &&
                         recording_.right.valid[row] && height_above_tips(predicted, left, right) < 0.0;
    return error;
  }

  Recording recording_;
  RecordedTips tips_;
  StartStates starts_;
  Track baseline_;
  FullPredictor<double> predictor_;
  StartsOnSpring<FullPredictor<double>> on_spring_;
  std::vector<PredictionWindow> windows_;
  Start start_;
};

}  // namespace diabolo
