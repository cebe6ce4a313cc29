// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "diabolo/diagnose/corrected.hpp"
#include "diabolo/diagnose/fit.hpp"
#include "diabolo/diagnose/folds.hpp"
#include "diabolo/diagnose/play_window.hpp"
#include "diabolo/full_predictor.hpp"
#include "diabolo/math/parallel.hpp"

namespace diabolo {

/// Windows one after the other, through which the axle is predicted in one go; place and spin begin anew in
/// each, as they were fitted, so that only what turns the axle counts.
struct AxleStretch {
  std::size_t fit_take;
  std::size_t first, last;  ///< windows of the take, both included
  std::size_t windows;      ///< that come before those of the take
  double seconds;
};

/// Windows that follow each other are predicted together for so long [s], and compared if that is most of
/// the longest.
inline constexpr double kAxleAhead = 0.9, kFarEnough = 0.7;

/// The recorded axle, and what models predict of it.
class AxleStretches {
 public:
  explicit AxleStretches(const Fit& fit) : fit_(&fit), scale_(1.0 + fit.at[index_of(Unknown::kLengthScale)]) {
    std::size_t windows = 0;
    for (std::size_t s = 0; s < fit.fit_takes.size(); ++s) {
      const FitTake& fit_take = fit.fit_takes[s];
      recordings_.push_back(corrected(fit_take.take->recording, fit.at));
      const Recording& recording = recordings_.back();
      motions_.push_back(RecordedTips(recording, Interpolation::kSpline).motion(0, recording.size() - 1));
      if (fit_take.take->has_orientation && fit_take.take->has_spin) add_stretches(s, windows);
      windows += fit_take.windows.size();
    }
  }

  const std::vector<AxleStretch>& all() const { return stretches_; }

  /// Whether a stretch is long enough to be compared.
  bool is_far_enough(std::size_t i) const {
    return stretches_[i].seconds >= kFarEnough * std::min(longest_, 1.0);
  }

  /// Its rows.
  Fold rows(const AxleStretch& stretch) const {
    return {stretch.fit_take, first_row(stretch), last_row(stretch)};
  }

  /// Of each recording that shows its axle, the rows from the first stretch to the last.
  std::vector<Fold> recordings() const {
    std::vector<Fold> result;
    for (const AxleStretch& stretch : stretches_) {
      if (result.empty() || result.back().fit_take != stretch.fit_take) result.push_back(rows(stretch));
      result.back().last = last_row(stretch);
    }
    return result;
  }

  /// The axle in all rows of all stretches where it was seen, each 3 x rows.
  std::vector<Eigen::Matrix3Xd> seen() const {
    std::vector<Eigen::Matrix3Xd> result;
    for (const AxleStretch& stretch : stretches_) {
      const FitTake& fit_take = fit_->fit_takes[stretch.fit_take];
      std::vector<Eigen::Index> rows;
      for (Eigen::Index row = first_row(stretch); row <= last_row(stretch); ++row)
        if (is_seen(fit_take, row)) rows.push_back(row);
      result.emplace_back(fit_take.take->axis(Eigen::all, rows));
    }
    return result;
  }

  std::vector<Eigen::Matrix3Xd> predicted(const Model& model, int threads, const Watch& watch) const {
    return predicted(model, threads, watch, [](std::size_t) { return true; });
  }

  /// What a model predicts of it from each stretch's first row on; nothing of those that do not count.
  template <class Counts>
  std::vector<Eigen::Matrix3Xd> predicted(const Model& model, int threads, const Watch& watch,
                                          const Counts& counts) const {
    std::vector<FullPredictor<double>> predictors;
    for (const Recording& recording : recordings_)
      predictors.emplace_back(parameters_for(model, recording), model.effects);
    std::vector<Eigen::Matrix3Xd> result(stretches_.size());
    for_each_index(stretches_.size(), threads, watch, [&](std::size_t i) {
      if (counts(i)) result[i] = play(stretches_[i], predictors[stretches_[i].fit_take]);
    });
    return result;
  }

 private:
  static bool is_seen(const FitTake& fit_take, Eigen::Index row) {
    return fit_take.take->recording.diabolo_orientation.valid[row];
  }
  Eigen::Index first_row(const AxleStretch& s) const {
    return fit_->fit_takes[s.fit_take].windows[s.first].first;
  }
  Eigen::Index last_row(const AxleStretch& s) const {
    return fit_->fit_takes[s.fit_take].windows[s.last].last;
  }

  /// Whether the recorded axle, which ends point forward of, is followed through a window: one that turns
  /// past a right angle is seen from its other end.
  static bool is_followed(const FitTake& fit_take, const FitWindow& window) {
    const Eigen::Matrix3Xd& axis = fit_take.take->axis;
    for (Eigen::Index row = window.first; row < window.last; ++row)
      if (axis.col(row).dot(axis.col(row + 1)) < 0.0) return false;
    return true;
  }

  /// Of windows whose motion is explained, the axle seen at the beginning.
  void add_stretches(std::size_t s, std::size_t before) {
    const FitTake& fit_take = fit_->fit_takes[s];
    const std::vector<FitWindow>& windows = fit_take.windows;
    const auto explained = [&](std::size_t w) {
      return fit_->scores[before + w].weight >= 1.0 && is_followed(fit_take, windows[w]);
    };
    const auto seconds = [&](std::size_t from, std::size_t to) {
      return fit_take.take->times[windows[to].last] - fit_take.take->times[windows[from].first];
    };
    for (std::size_t w = 0; w < windows.size(); ++w) {
      if (!explained(w) || !is_seen(fit_take, windows[w].first)) continue;
      std::size_t last = w;
      while (last + 1 < windows.size() && windows[last + 1].first == windows[last].last &&
             explained(last + 1) && seconds(w, last) < kAxleAhead)
        ++last;
      stretches_.push_back({s, w, last, before, seconds(w, last)});
      longest_ = std::max(longest_, seconds(w, last));
      w = last;
    }
  }

  Eigen::Matrix3Xd play(const AxleStretch& stretch, const FullPredictor<double>& predictor) const {
    const FitTake& fit_take = fit_->fit_takes[stretch.fit_take];
    const Take& take = *fit_take.take;
    const TipMotion<double>& motion = *motions_[stretch.fit_take];
    Eigen::Matrix3Xd predicted(3, last_row(stretch) - first_row(stretch) + 1);
    Eigen::Index rows = 0;
    State<double> state;
    state.axis = take.axis.col(first_row(stretch));
    for (std::size_t w = stretch.first; w <= stretch.last; ++w) {
      const FitWindow& window = fit_take.windows[w];
      begin(state, window);
      const auto look = [&](Eigen::Index row, const State<double>& at, const auto&) {
        const bool is_old = row == window.first && w > stretch.first;  // the last row of the window before
        if (!is_old && is_seen(fit_take, row)) predicted.col(rows++) = at.axis;
      };
      diagnose_detail::play_window(take, window, motion, predictor, state, look);
    }
    return predicted.leftCols(rows);
  }

  /// Lets place and spin begin anew as they were fitted, and the axle go on.
  void begin(State<double>& state, const FitWindow& window) const {
    const State<double> before = state;
    state = window.start;
    state.position /= scale_;
    state.velocity /= scale_;
    state.axis = before.axis;
    state.tumble = before.tumble;
  }

  const Fit* fit_;
  double scale_;
  std::vector<Recording> recordings_;
  std::vector<std::shared_ptr<const TipMotion<double>>> motions_;
  std::vector<AxleStretch> stretches_;
  double longest_ = 0.0;  ///< [s]
};

}  // namespace diabolo
