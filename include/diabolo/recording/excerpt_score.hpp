// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diabolo/recording/baseline.hpp"
#include "diabolo/recording/model.hpp"
#include "diabolo/recording/paper_table.hpp"
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

/// Scores the recording by the recipe of the paper's table. Throws RecordingError where it has no row to
/// start from or to compare.
ExcerptScore score_excerpt(const Recording& recording, const Model& model);

/// The excerpt of the paper's table that this take is or contains, if any, and then the take as a whole
/// unless it is that excerpt.
std::vector<ExcerptScore> score_excerpts(const Recording& recording, const Model& model);

}  // namespace diabolo
