// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "diabolo/math/least_squares.hpp"
#include "diabolo/plan/level_regulator.hpp"
#include "diabolo/plan/turning_hands.hpp"

namespace diabolo {

/// What is foreseen of a play whose hands turn it, in steps of equal length, and what that costs.
struct LevelForesight {
  static constexpr std::size_t kPieces = 6;  ///< of constant wanted lead and turn
  static constexpr std::size_t kSteps = 40;  ///< of a piece
  static constexpr double kStep = 5e-3;      ///< [s]
  static constexpr double kPiece = 0.2;      ///< kSteps of them [s]

  State<double> start;
  bool in_air = false;               ///< whether the diabolo is in_the_air() then
  TurningHands hands;                ///< as they are at the start
  double quickness = 10.0;           ///< of the hands, see LevelHandLimits
  std::vector<Tips<double>> base{};  ///< the play's tips, not turned; one more than there are steps
  LevelWeights weights{};
  double place = 0.2;  ///< off the place that the play has for the diabolo, at which it costs one [m]
  Eigen::Matrix3d to_go = Eigen::Matrix3d::Zero();  ///< see LevelRegulator
  std::vector<Vector3<double>> places{};            ///< where the play has the diabolo, seen from the hands

  /// Fills `places`: of hands that stay turned as they are.
  void foresee_places(const FullPredictor<double>& model) {
    TurningHands still = hands;
    still.turn = still.lead_rate = 0.0;
    places.clear();
    State<double> state = start;
    for (std::size_t i = 0; i + 1 < base.size(); ++i) {
      model.step(state, still.tips(base[i]), still.tips(base[i + 1]), kStep);
      places.push_back(still.seen(state.position));
    }
  }

  /// Residuals whose squares are the regulator's cost and that of the diabolo's place. `x` is the wanted lead
  /// [rad] of each piece, then the wanted turn [rad/s] of each.
  Eigen::VectorXd residuals(const FullPredictor<double>& model, const std::vector<double>& x) const {
    std::vector<double> parts;
    const auto add = [&parts](double value, double time, double size) {
      parts.push_back(value * std::sqrt(time) / size);
    };
    State<double> state = start;
    bool flies = in_air;
    TurningHands moved = hands;
    Tips<double> tips = moved.tips(base.front());
    Eigen::Vector3d angles = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i + 1 < base.size(); ++i) {
      flies = in_the_air(flies, state.string_state);
      moved.follow(flies ? 0.0 : x[i / kSteps], x[kPieces + i / kSteps], kStep, quickness);
      const Tips<double> next = moved.tips(base[i + 1]);
      model.step(state, tips, next, kStep);
      tips = next;
      if ((i + 1) % kJudged != 0) continue;
      const auto [tilt, yaw] = axle_angles(state.axis);
      const double heading = moved.turned.heading;
      const double beside = std::remainder(yaw - heading, 2.0 * std::numbers::pi);
      angles = {tilt, heading + beside, heading};
      add(tilt, kJudged * kStep, weights.tilt);
      add(beside, kJudged * kStep, weights.yaw);
      add(heading, kJudged * kStep, weights.heading);
      const Vector3<double> off = moved.seen(state.position) - places[i];
      for (int k = 0; k < 3; ++k) add(off[k], kJudged * kStep, place);
    }
    for (std::size_t piece = 0; piece < kPieces; ++piece) {
      add(x[piece], kPiece, weights.lead);
      add(x[kPieces + piece], kPiece, weights.turn);
    }
    const Eigen::Vector3d later = to_go.llt().matrixU() * angles;
    for (int k = 0; k < 3; ++k) add(later[k], 1.0, 1.0);
    return Eigen::Map<const Eigen::VectorXd>(parts.data(), static_cast<Eigen::Index>(parts.size()));
  }

  /// Derivatives by forward differences: a dozen plays of doubles take as long as one of dual numbers.
  Linearization linearized(const FullPredictor<double>& model, const std::vector<double>& x) const {
    constexpr double kSmall = 1e-5;
    Linearization result{residuals(model, x), {}};
    result.jacobian.resize(result.residuals.size(), static_cast<Eigen::Index>(x.size()));
    for (std::size_t i = 0; i < x.size(); ++i) {
      std::vector<double> above = x;
      above[i] += kSmall;
      result.jacobian.col(static_cast<Eigen::Index>(i)) =
          (residuals(model, above) - result.residuals) / kSmall;
    }
    return result;
  }

 private:
  static constexpr int kJudged = 10;  // steps
};

}  // namespace diabolo
