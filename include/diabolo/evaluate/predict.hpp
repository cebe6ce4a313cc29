// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/evaluate/evaluation_step.hpp"
#include "diabolo/evaluate/excerpt_score.hpp"
#include "diabolo/evaluate/start_on_spring.hpp"
#include "diabolo/evaluate/start_state.hpp"
#include "diabolo/math/parallel.hpp"
#include "diabolo/model.hpp"
#include "diabolo/recording/check.hpp"
#include "diabolo/recording/tip_motion.hpp"
#include "diabolo/rollout.hpp"
#include "diabolo/strand_tensions.hpp"

namespace diabolo {

/// The diabolo at the rows of a recording from `first` on.
struct Prediction {
  Eigen::Index first = 0;
  std::vector<State<double>> states;
  /// Of the string on the tips, in the step that ends at each row; at the first row in the one that begins.
  std::vector<TipForces<double>> forces;
};

/// The state at a row; `starts` are the recording's. Throws std::invalid_argument where a prediction cannot
/// start there.
inline State<double> start_state(const Recording& recording, const StartStates& starts, Start start,
                                 Eigen::Index row) {
  const auto fail = [&](const std::string& why) {
    throw std::invalid_argument(recording.title() + ": row " + std::to_string(row) + why);
  };
  if (row < 0 || row >= recording.size()) fail("; expected 0 to " + std::to_string(recording.size() - 1));
  if (!starts.known(start, row))
    fail(start == Start::kFair ? " cannot be a start: the diabolo must be seen there and for 0.1 s before"
                               : " cannot be a start: the diabolo must be seen there and in the next row");
  return starts.at(start, row);
}

/// Predicts the diabolo at each row of a recording from its state at one row (a fair one on a stiff
/// spring is brought to rest on it, see StartsOnSpring) and the recorded tips: the first
/// step of kEvaluationStep at or after the row. `row` is by default the first one from which the authors'
/// program could start. Throws RecordingError, std::invalid_argument where it cannot start at the row, and
/// Cancelled.
inline Prediction predict(const Recording& recording, const Model& model, Start start = Start::kPublished,
                          std::optional<Eigen::Index> row = {}, const Watch& watch = {}) {
  check_recording(recording);
  const StartStates starts(recording, has_signed_spin(model));
  Prediction result;
  result.first = row ? *row : first_start(recording, starts);
  State<double> begin = start_state(recording, starts, start, result.first);
  const RecordedTips tips(recording, model.interpolation);
  const Eigen::Index last = recording.size() - 1;
  const auto elapsed = [&](Eigen::Index at) { return tips.times()[at] - tips.times()[result.first]; };
  const auto record = [&](std::size_t step, const State<double>& state, const TipForces<double>& forces) {
    for (Eigen::Index next = result.first + static_cast<Eigen::Index>(result.states.size());
         next <= last && steps_until(elapsed(next)) == step; ++next) {
      result.states.push_back(state);
      result.forces.push_back(forces);
    }
  };
  const auto motion = tips.motion(result.first, last);
  const Steps steps{tips.times()[result.first], kEvaluationStep, steps_until(elapsed(last))};
  const FullPredictor<double> predictor = predictor_for(model, recording);
  StartsOnSpring(predictor, recording).place(begin, predictor, *motion, steps.begin, steps.dt);
  record(0, begin, {});
  State<double> before = begin;
  std::size_t hint = 0;
  Tips<double> tips_before = motion->at(steps.begin, hint);
  rollout(predictor, begin, *motion, steps,
          [&](std::size_t step, double time, const State<double>& state, const StepStatus<double>&) {
            if (watch.cancelled && watch.cancelled()) throw Cancelled();
            const Tips<double> tips_now = motion->at(time, hint);
            const TipForces<double> forces =
                tip_forces(predictor, before, state, tips_before, tips_now, kEvaluationStep);
            if (step == 1) std::ranges::fill(result.forces, forces);
            record(step, state, forces);
            before = state;
            tips_before = tips_now;
          });
  return result;
}

}  // namespace diabolo
