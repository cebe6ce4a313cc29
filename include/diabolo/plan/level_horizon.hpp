// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "diabolo/plan/level_foresight.hpp"
#include "diabolo/plan/play.hpp"

namespace diabolo {

/// Hands that keep the axle level as LevelHands do, by a receding horizon: the lead and the turn of the next
/// 1.2 s are planned on the model with its free axle while the hands play what is planned of their tips, so
/// that pulls, throws, flights and catches to come count, and the place of the diabolo with the axle. What
/// comes later costs what it does under the regulator (the quasi-infinite horizon of Chen and Allgower,
/// Automatica 34, 1998). The plan is found as GradientSearch finds one, by least_squares(), from the last one
/// on.
class LevelHorizon {
 public:
  static constexpr double kAgain = 0.1;  ///< from a plan to the next one [s]
  /// As those of LevelHands, but that a lead may be twice as large: pulls to come are known, so that less of
  /// it is in vain.
  static constexpr LevelWeights kWeights{.lead = 0.6};

  /// As LevelHands.
  LevelHorizon(const FullPredictor<double>& model, const Tips<double>& home, double spin,
               const LevelWeights& weights = kWeights, const LevelHandLimits& limits = {})
      : regulator_(model, home, spin, weights),
        model_(without_nutation(model)),
        limits_(limits),
        wanted_(2 * LevelForesight::kPieces, 0.0) {
    limits.validate();
    foresight_.weights = weights;
    foresight_.quickness = limits.quickness;
    hands_.turned.pivot = 0.5 * (home.left + home.right);
  }

  /// Takes in what is seen of the diabolo at a time [s] that does not decrease, in the world; `path` is what
  /// the hands are to play, not turned. Each kAgain it is planned anew, by the mean of the axles seen since.
  void see(double time, const State<double>& state, const TipPath<double>& path) {
    axles_ += state.axis;
    in_air_ = in_the_air(in_air_, state.string_state);
    if (time < planned_ + kAgain - 1e-9) return;
    foresight_.start = state;
    foresight_.start.axis = axles_.norm() > 1e-3 ? Vector3<double>(axles_.normalized()) : state.axis;
    foresight_.start.tumble.setZero();
    axles_.setZero();
    plan(time, path);
  }

  /// Lets the hands follow for `dt` [s].
  void advance(double dt) {
    const std::size_t piece = piece_after(since_);
    hands_.follow(in_air_ ? 0.0 : wanted_[piece], wanted_[LevelForesight::kPieces + piece], dt,
                  limits_.quickness);
    since_ += dt;
  }

  const Turned& turned() const { return hands_.turned; }
  Tips<double> tips(const Tips<double>& base) const { return hands_.tips(base); }

 private:
  static constexpr int kIterations = 1;  // from the last plan on

  static FullPredictor<double> without_nutation(const FullPredictor<double>& model) {
    AllEffects<double> effects = model.effects();
    effects.get<GyroscopicTilt>().inertia_ratio = 0.0;
    return FullPredictor<double>(model.parameters(), effects);
  }

  /// Of the last plan, `time` [s] after it was made.
  static std::size_t piece_after(double time) {
    const auto piece = static_cast<std::size_t>(std::max(0.0, time) / LevelForesight::kPiece);
    return std::min(piece, LevelForesight::kPieces - 1);
  }

  void plan(double time, const TipPath<double>& path) {
    constexpr std::size_t kPieces = LevelForesight::kPieces;
    foresight_.hands = hands_;
    foresight_.in_air = in_air_;
    foresight_.to_go = regulator_.at(foresight_.start.spin).to_go;
    foresight_.base.clear();
    std::size_t hint = 0;
    for (std::size_t i = 0; i <= kPieces * LevelForesight::kSteps; ++i)
      foresight_.base.push_back(path.at(time + static_cast<double>(i) * LevelForesight::kStep, hint));
    foresight_.foresee_places(model_);
    std::vector<double> x(wanted_.size()), bounds(wanted_.size(), limits_.lead);
    std::fill(bounds.begin() + kPieces, bounds.end(), limits_.turn);
    for (std::size_t k = 0; k < kPieces; ++k) {
      const std::size_t piece = piece_after(since_ + (static_cast<double>(k) + 0.5) * LevelForesight::kPiece);
      x[k] = wanted_[piece];
      x[kPieces + k] = wanted_[kPieces + piece];
    }
    const auto value = [&](const std::vector<double>& at) {
      return foresight_.residuals(model_, at).squaredNorm();
    };
    const auto linearize = [&](const std::vector<double>& at) { return foresight_.linearized(model_, at); };
    least_squares(x, bounds, kIterations, 1.0, 1e-3, value, linearize, [] { return false; });
    wanted_ = x;
    planned_ = time;
    since_ = 0.0;
  }

  RegulatorBySpin regulator_;
  FullPredictor<double> model_;
  LevelHandLimits limits_;
  LevelForesight foresight_;
  TurningHands hands_;
  bool in_air_ = false;
  std::vector<double> wanted_;  ///< of the last plan, see LevelForesight::residuals()
  Vector3<double> axles_ = Vector3<double>::Zero();
  double planned_ = -std::numeric_limits<double>::infinity(), since_ = 0.0;  ///< [s]
};

}  // namespace diabolo
