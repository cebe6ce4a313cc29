// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "diabolo/learn/hands.hpp"

namespace diabolo {

/// Shares of the tips' largest accelerations: left x, y, z, right x, y, z (see move_hands).
using HandShares = std::array<double, 6>;

/// A planned play as an agent's hands play it, a period at a time. An agent's actions are added to its
/// accelerations, and a spring with critical damping brings the hands back to it. Without the spring what is
/// added sums up, and hands that explore leave the plan for good.
struct HandPlan {
  /// Of what the tips may accelerate, so much is added where an action is one.
  static constexpr double kCorrection = 0.5;
  static constexpr double kReturn = 0.15;  ///< of the spring, the time in which it brings them back [s]

  /// The begin of a period: where all of it is by the plan, and what the hands do then.
  struct Moment {
    Hands hands;
    Vector3<double> position = Vector3<double>::Zero(), velocity = position;  ///< of the diabolo [m], [m/s]
    HandShares shares{};
  };

  double period = 0.0;          ///< [s]
  std::vector<Moment> moments;  ///< at least one; at the last one the hands rest, and go on doing so

  const Moment& at(std::size_t number) const { return moments[std::min(number, moments.size() - 1)]; }

  /// From such a moment to the last one [s].
  double time_left(std::size_t number) const {
    return period * static_cast<double>(moments.size() - 1 - std::min(number, moments.size() - 1));
  }

  /// What hands do in a period: the plan, the correction `action` of six shares, and the way back to the
  /// plan.
  template <class Number>
  HandShares corrected(std::size_t number, const Number* action, const Hands& hands,
                       double most_acceleration) const {
    const Moment& plan = at(number);
    HandShares shares = plan.shares;
    for (std::size_t k = 0; k < shares.size(); ++k) {
      const std::size_t side = k / 3;
      const auto axis = static_cast<Eigen::Index>(k % 3);
      const double off = hands.position[side][axis] - plan.hands.position[side][axis],
                   faster = hands.velocity[side][axis] - plan.hands.velocity[side][axis];
      shares[k] += kCorrection * std::clamp(static_cast<double>(action[k]), -1.0, 1.0) -
                   (off / kReturn + 2.0 * faster) / (kReturn * most_acceleration);
    }
    return shares;
  }
};

}  // namespace diabolo
