// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "diabolo/diagnose/axle_stretches.hpp"
#include "diabolo/diagnose/folds.hpp"

namespace diabolo::diagnose_detail {

/// Half a turn where a prediction came to nothing.
inline double angle_between(const Vector3<double>& predicted, const Vector3<double>& seen) {
  const double angle = std::atan2(predicted.cross(seen).norm(), predicted.dot(seen));
  return std::isfinite(angle) ? angle : std::numbers::pi;
}

/// Which stretches are judged together, and which of the fitted ones say how they are predicted.
struct AxlePart {
  std::vector<bool> judged, others;
};

/// Stretches that judge laws of the axle: all of `heldout`, by all that were fitted; or, where that shows no
/// axle, each fold of the fitted ones by those that do not touch it. Both have to outlive it.
class AxleLeftOut {
 public:
  AxleLeftOut(const AxleStretches& fitted, const AxleStretches& heldout)
      : stretches_(heldout.all().empty() ? &fitted : &heldout),
        whole_recordings_(stretches_ == &heldout || fitted.recordings().size() > 1) {
    const std::size_t count = fitted.all().size();
    if (stretches_ == &heldout) {
      parts_.push_back({std::vector<bool>(heldout.all().size(), true), std::vector<bool>(count, true)});
      return;
    }
    for (const Fold& fold : folds_of(fitted.recordings())) {
      AxlePart part;
      for (const AxleStretch& stretch : fitted.all()) {
        const Fold rows = fitted.rows(stretch);
        part.judged.push_back(touch(fold, {rows.fit_take, rows.first, rows.first}));
        part.others.push_back(!touch(fold, rows));
      }
      if (std::ranges::count(part.judged, true) > 0 && std::ranges::count(part.others, true) > 0)
        parts_.push_back(part);
    }
  }

  bool whole_recordings() const { return whole_recordings_; }

  /// How long the stretches are that are compared [s], in the order of the angles below.
  std::vector<double> seconds() const {
    std::vector<double> result;
    each([&](const AxlePart&, const auto& counts) {
      for (std::size_t i = 0; i < stretches_->all().size(); ++i)
        if (counts(i)) result.push_back(stretches_->all()[i].seconds);
    });
    return result;
  }

  /// Angles at their ends between what the model of each part predicts and what was seen [rad].
  template <class ModelOf>
  std::vector<double> errors(const ModelOf& model_of, int threads, const Watch& watch) const {
    return angles([&](const AxlePart& part, const auto& counts) {
      return stretches_->predicted(model_of(part), threads, watch, counts);
    });
  }

  /// The same of an axle that keeps its direction.
  std::vector<double> errors_of_constant() const {
    std::vector<Eigen::Matrix3Xd> first;
    for (const Eigen::Matrix3Xd& axle : stretches_->seen()) first.emplace_back(axle.leftCols<1>());
    return angles([&](const AxlePart&, const auto&) { return first; });
  }

 private:
  /// Calls `visit` for each part, with which of its stretches are compared.
  template <class Visit>
  void each(const Visit& visit) const {
    for (const AxlePart& part : parts_)
      visit(part, [&](std::size_t i) { return part.judged[i] && stretches_->is_far_enough(i); });
  }

  template <class Predict>
  std::vector<double> angles(const Predict& predict) const {
    const std::vector<Eigen::Matrix3Xd> seen = stretches_->seen();
    std::vector<double> result;
    each([&](const AxlePart& part, const auto& counts) {
      const std::vector<Eigen::Matrix3Xd> predicted = predict(part, counts);
      for (std::size_t i = 0; i < seen.size(); ++i)
        if (counts(i)) result.push_back(angle_between(predicted[i].rightCols<1>(), seen[i].rightCols<1>()));
    });
    return result;
  }

  const AxleStretches* stretches_;
  bool whole_recordings_;
  std::vector<AxlePart> parts_;
};

}  // namespace diabolo::diagnose_detail
