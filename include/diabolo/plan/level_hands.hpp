// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <numbers>

#include "diabolo/plan/level_regulator.hpp"
#include "diabolo/plan/turning_hands.hpp"

namespace diabolo {

/// Hands that keep the axle of a diabolo level while they play any motion: the motion turned towards the
/// axle, and beyond it to tilt it, by the gains of level_regulator() for the spin that is seen; without a
/// lead from a throw to its catch.
class LevelHands {
 public:
  static constexpr LevelWeights kWeights{};  ///< where nothing is said

  /// `home` are the hands of the play at rest; the play turns about the vertical through their middle. Throws
  /// as axle_response() does.
  LevelHands(const FullPredictor<double>& model, const Tips<double>& home, double spin,
             const LevelWeights& weights = kWeights, const LevelHandLimits& limits = {})
      : regulator_(model, home, spin, weights), limits_(limits) {
    limits.validate();
    hands_.turned.pivot = 0.5 * (home.left + home.right);
  }

  /// Takes in what is seen of the diabolo: the hands will answer it from now on; with the last gains where it
  /// is too slow to steer.
  void see(const Vector3<double>& axis, double spin, StringState string = StringState::kOnString) {
    const AxleAngles angles = axle_angles(axis);
    const double heading = hands_.turned.heading;
    const double yaw = std::remainder(angles.yaw - heading, 2.0 * std::numbers::pi);
    const Eigen::Vector2d wanted =
        -regulator_.at(spin).gains * Eigen::Vector3d(angles.tilt, heading + yaw, heading);
    in_air_ = in_the_air(in_air_, string);
    wanted_lead_ = in_air_ ? 0.0 : std::clamp(wanted[0], -limits_.lead, limits_.lead);
    wanted_turn_ = std::clamp(wanted[1], -limits_.turn, limits_.turn);
  }

  /// Lets the hands follow for `dt` [s].
  void advance(double dt) { hands_.follow(wanted_lead_, wanted_turn_, dt, limits_.quickness); }

  const Turned& turned() const { return hands_.turned; }
  /// Gains for the spin that was learnt last; see level_regulator().
  const Eigen::Matrix<double, 2, 3>& gains() const { return regulator_.last().gains; }

  /// The tips of the motion as these hands play it now, with their velocities.
  Tips<double> tips(const Tips<double>& base) const { return hands_.tips(base); }

 private:
  RegulatorBySpin regulator_;
  LevelHandLimits limits_;
  TurningHands hands_;
  double wanted_lead_ = 0.0, wanted_turn_ = 0.0;
  bool in_air_ = false;
};

}  // namespace diabolo
