// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diabolo/evaluate/baseline.hpp"
#include "diabolo/evaluate/evaluation_step.hpp"
#include "diabolo/evaluate/paper_table.hpp"
#include "diabolo/evaluate/start_state.hpp"
#include "diabolo/math/parallel.hpp"
#include "diabolo/model.hpp"
#include "diabolo/recording/check.hpp"
#include "diabolo/recording/tip_motion.hpp"
#include "diabolo/rollout.hpp"

namespace diabolo {

/// Position error of one rollout over a recording, as the paper's table counts it.
struct ExcerptScore {
  std::string recording;                ///< name of the take
  std::string motion;                   ///< as the paper calls it; empty where its table has no such excerpt
  std::string model;                    ///< name
  Eigen::Index rows = 0;                ///< of the excerpt
  Eigen::Index start_row = 0;           ///< 0 unless the diabolo or a tip is missing there
  Eigen::Index scored = 0;              ///< rows compared
  Eigen::Index skipped = 0;             ///< rows after the start whose diabolo, or the one before, is missing
  double duration = 0.0;                ///< from the start to the last row compared [s]
  std::optional<double> error;          ///< mean distance to the recorded diabolo [m]; none where it diverged
  std::optional<double> diverged;       ///< when the prediction became non-finite or left the world [s]
  double baseline_error = 0.0;          ///< of the lowest-point baseline over the same rows [m]
  std::optional<double> paper_error;    ///< as the paper prints it [m]
  std::optional<double> program_error;  ///< the authors' program, run again [m]
};

/// The first row at which the published start and both tips are known. Throws RecordingError where there is
/// none.
inline Eigen::Index first_start(const Recording& recording, const StartStates& starts) {
  bool left = false, right = false;
  for (Eigen::Index i = 0; i < recording.size(); ++i) {
    left = left || recording.left.valid[i];
    right = right || recording.right.valid[i];
    if (left && right && starts.known(Start::kPublished, i)) return i;
  }
  throw RecordingError(recording.title() +
                       ": no two successive rows with the diabolo, and both tips, to start from");
}

/// Scores the recording by the recipe of the paper's table: one rollout from the published start at the first
/// row where that is known, steps of kEvaluationStep, mean Euclidean distance at the first sample at or after
/// each row but the last one. Throws RecordingError where it has no row to start from or to compare, and
/// Cancelled.
inline ExcerptScore score_excerpt(const Recording& recording, const Model& model, const Watch& watch = {}) {
  check_recording(recording);
  const RecordedTips tips(recording, model.interpolation);
  const Eigen::VectorXd& times = tips.times();
  const StartStates starts(recording, has_signed_spin(model));
  const Track baseline = baseline_track(recording);
  ExcerptScore score;
  score.recording = recording.name;
  score.model = model.name;
  score.rows = recording.size();
  score.start_row = first_start(recording, starts);
  if (const PaperExcerpt* excerpt = paper_excerpt(recording.name);
      excerpt != nullptr && excerpt->rows == recording.size()) {
    score.motion = excerpt->motion;
    score.paper_error = excerpt->paper_error;
    score.program_error = excerpt->program_error;
  }

  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = score.start_row + 1; i + 1 < recording.size(); ++i)
    if (recording.diabolo.valid[i] && recording.diabolo.valid[i - 1]) rows.push_back(i);
  if (rows.empty()) throw RecordingError(recording.title() + ": no row to compare");
  score.scored = static_cast<Eigen::Index>(rows.size());
  score.skipped = recording.size() - 2 - score.start_row - score.scored;
  const double start_time = times[score.start_row];
  score.duration = times[rows.back()] - start_time;

  const Steps steps{start_time, kEvaluationStep, steps_until(score.duration)};
  double error_sum = 0.0, baseline_sum = 0.0;
  std::size_t next = 0;
  rollout(predictor_for(model, recording), starts.at(Start::kPublished, score.start_row),
          *tips.motion(score.start_row, recording.size() - 1), steps,
          [&](std::size_t step, double time, const State<double>& state, const StepStatus<double>&) {
            if (watch.cancelled && watch.cancelled()) throw Cancelled();
            if (!score.diverged && !is_in_world(state.position)) score.diverged = time - start_time;
            for (; next < rows.size() && steps_until(times[rows[next]] - start_time) <= step; ++next) {
              error_sum += (state.position - recording.diabolo.position.col(rows[next])).norm();
              baseline_sum +=
                  (baseline.position.col(rows[next]) - recording.diabolo.position.col(rows[next])).norm();
            }
          });
  const double count = static_cast<double>(score.scored);
  if (!score.diverged) score.error = error_sum / count;
  score.baseline_error = baseline_sum / count;
  return score;
}

/// The excerpt of the paper's table that this take is or contains, if any, and then the take as a whole
/// unless it is that excerpt.
inline std::vector<ExcerptScore> score_excerpts(const Recording& recording, const Model& model,
                                                const Watch& watch = {}) {
  std::vector<ExcerptScore> scores;
  if (const PaperExcerpt* excerpt = paper_excerpt(recording.name);
      excerpt != nullptr && excerpt->rows < recording.size())
    scores.push_back(score_excerpt(cut(recording, 0, excerpt->rows - 1), model, watch));
  scores.push_back(score_excerpt(recording, model, watch));
  return scores;
}

}  // namespace diabolo
