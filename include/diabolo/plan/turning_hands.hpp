// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "diabolo/plan/turned.hpp"
#include "diabolo/state.hpp"
#include "diabolo/text/expect_positive.hpp"

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

/// Whether a diabolo is in the air, from when it flies until a string pulls it again; `before`: whether it
/// was. Hands take no lead then: it would tilt nothing, and they would catch the axle askew.
inline bool in_the_air(bool before, StringState string) {
  return string == StringState::kFlying || (before && string != StringState::kOnString);
}

/// Hands that play any motion turned, and follow a wanted lead and turn: the lead critically damped, the rate
/// of the heading with a lag of first order. Both are exact for what is wanted constantly.
struct TurningHands {
  Turned turned;
  double lead_rate = 0.0, turn = 0.0;  ///< [rad/s]

  /// Follows the lead [rad] and the rate of the heading [rad/s] for `dt` [s].
  void follow(double lead, double rate, double dt, double quickness) {
    const double gap = turned.lead - lead, fade = std::exp(-quickness * dt);
    const double pushed = lead_rate + quickness * gap;
    turned.lead = lead + (gap + pushed * dt) * fade;
    lead_rate = (lead_rate - quickness * pushed * dt) * fade;
    const double next = rate + (turn - rate) * fade;
    turned.heading += 0.5 * (turn + next) * dt;
    turn = next;
  }

  /// The tips of the motion as these hands play it now, with their velocities.
  Tips<double> tips(const Tips<double>& base) const {
    Tips<double> tips = turned(base);
    const Eigen::Vector3d rate = (turn + lead_rate) * Eigen::Vector3d::UnitZ();
    tips.left_velocity = turned(base.left_velocity) + cross<double>(rate, tips.left - turned.pivot);
    tips.right_velocity = turned(base.right_velocity) + cross<double>(rate, tips.right - turned.pivot);
    return tips;
  }

  /// A place as these hands see it: where it is before their motion is turned.
  Eigen::Vector3d seen(const Eigen::Vector3d& place) const {
    const Turned back{-turned.heading, -turned.lead, turned.pivot};
    return turned.pivot + back(Eigen::Vector3d(place - turned.pivot));
  }
};

}  // namespace diabolo
