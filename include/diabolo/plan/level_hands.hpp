// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <numbers>

#include "diabolo/plan/level_gains.hpp"

namespace diabolo {

/// What hands may do to level the axle.
struct LevelHandLimits {
  double lead = 0.9;        ///< of the hands before the heading [rad]
  double turn = 1.0;        ///< rate of the heading [rad/s]
  double quickness = 10.0;  ///< of the hands: they follow what is wanted with this rate [1/s]

  /// Throws std::invalid_argument where one is out of its range.
  void validate() const {
    expect_positive("lead", lead, 1.5, "rad");
    expect_positive("turn", turn, 10.0, "rad/s");
    expect_positive("quickness", quickness, 100.0, "1/s");
  }
};

/// Hands that keep the axle of a diabolo level while they play any motion: the motion turned towards the
/// axle, and beyond it to tilt it, by the gains of level_gains() for the spin that is seen.
class LevelHands {
 public:
  /// `home` are the hands of the play at rest; the play turns about the vertical through their middle. Throws
  /// as axle_response() does.
  LevelHands(const FullPredictor<double>& model, const Tips<double>& home, double spin,
             const LevelWeights& weights = {}, const LevelHandLimits& limits = {})
      : model_(model), home_(home), weights_(weights), limits_(limits) {
    limits.validate();
    turned_.pivot = 0.5 * (home.left + home.right);
    learn(spin);
  }

  /// Takes in what is seen of the diabolo: the hands will answer it from now on; with the last gains where it
  /// is too slow to steer.
  void see(const Vector3<double>& axis, double spin) {
    const bool steers = std::abs(spin) >= kSlowestToSteer;
    if (steers && std::abs(spin - learnt_spin_) > kRelearn * std::abs(learnt_spin_)) learn(spin);
    const AxleAngles angles = axle_angles(axis);
    const double yaw = std::remainder(angles.yaw - turned_.heading, 2.0 * std::numbers::pi);
    const Eigen::Vector2d wanted =
        -gains_ * Eigen::Vector3d(angles.tilt, turned_.heading + yaw, turned_.heading);
    wanted_lead_ = std::clamp(wanted[0], -limits_.lead, limits_.lead);
    wanted_turn_ = std::clamp(wanted[1], -limits_.turn, limits_.turn);
  }

  /// Lets the hands follow for `dt` [s].
  void advance(double dt) {
    const double k = limits_.quickness;
    // Critically damped towards what is wanted, exact for a constant one.
    const double gap = turned_.lead - wanted_lead_, fade = std::exp(-k * dt);
    const double pushed = lead_rate_ + k * gap;
    turned_.lead = wanted_lead_ + (gap + pushed * dt) * fade;
    lead_rate_ = (lead_rate_ - k * pushed * dt) * fade;
    const double turn = wanted_turn_ + (turn_ - wanted_turn_) * fade;
    turned_.heading += 0.5 * (turn_ + turn) * dt;
    turn_ = turn;
  }

  const Turned& turned() const { return turned_; }
  /// Gains for the spin that was learnt last; see level_gains().
  const Eigen::Matrix<double, 2, 3>& gains() const { return gains_; }

  /// The tips of the motion as these hands play it now, with their velocities.
  Tips<double> tips(const Tips<double>& base) const {
    Tips<double> tips = turned_(base);
    const Eigen::Vector3d rate = (turn_ + lead_rate_) * Eigen::Vector3d::UnitZ();
    tips.left_velocity = turned_(base.left_velocity) + cross<double>(rate, tips.left - turned_.pivot);
    tips.right_velocity = turned_(base.right_velocity) + cross<double>(rate, tips.right - turned_.pivot);
    return tips;
  }

 private:
  static constexpr double kRelearn = 0.1;  // share of the spin

  void learn(double spin) {
    gains_ = level_gains(axle_response(model_, home_, spin), weights_);
    learnt_spin_ = spin;
  }

  FullPredictor<double> model_;
  Tips<double> home_;
  LevelWeights weights_;
  LevelHandLimits limits_;
  Turned turned_;
  Eigen::Matrix<double, 2, 3> gains_;
  double learnt_spin_ = 0.0, wanted_lead_ = 0.0, wanted_turn_ = 0.0, lead_rate_ = 0.0, turn_ = 0.0;
};

}  // namespace diabolo
