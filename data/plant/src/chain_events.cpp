// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "chain.hpp"

namespace plant {
namespace {

constexpr double kReleaseHeight = 0.04;  // above the line of the tips: a slack string no longer holds it [m]
constexpr double kNearestNode = 5e-4;    // to the axle, before it goes round [m]
constexpr double kTautPull = 0.1;        // smoothed, of a string that counts as taut [N]
constexpr double kNearestPlace = 1e-4;   // and after it [m]
constexpr double kNearestTip = 1e-3;     // [m]

}  // namespace

Pair<Vec3> ChainPlant::ends(const Moment& moment) const {
  return {moment.chain.places.front(), moment.chain.places.back()};
}

/// The node at `side` of the axle goes round it: the string's path keeps its length and its stretch, and axle
/// and node collide without loss, so that the node leaves along the other strand as fast as it came.
void ChainPlant::pass_node(Moment& moment, const Bight& bight, std::size_t side) const {
  ChainState& chain = moment.chain;
  const std::size_t node = chain.bight + side;
  const std::size_t other = 1 - side;
  const double stretch = std::max(1.0, bight.length() / measures_.rest(true));
  const double remaining = stretch * measures_.patch - bight.arc - bight.straights[side];
  if (!(remaining > kNearestPlace)) return;  // wound so far round that the string must come back first
  const Vec3 centre = moment.state.col(kPosition);
  chain.places[node] = centre + bight.arms[other] + remaining * bight.directions[other];

  const Vec3 before = chain.velocities[node] - moment.state.col(kVelocity);
  const auto turn = Eigen::Quaterniond::FromTwoVectors(-bight.directions[side], bight.directions[other]);
  const Vec3 after = turn * before;
  const double share = measures_.node_mass / (measures_.node_mass + parameters_.diabolo.mass);
  moment.state.col(kVelocity) += share * (before - after);
  chain.velocities[node] = moment.state.col(kVelocity) + after;
  if (side == 0) {
    --chain.bight;
  } else {
    ++chain.bight;
  }
}

/// Sends nodes round the axle that are nearer than half of where they should go round.
void ChainPlant::make_way(Moment& moment) const {
  const Bight now = bight(moment);
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t node = moment.chain.bight + side;
    const bool is_tip = node == 0 || node + 1 == moment.chain.places.size();
    if (is_tip || now.straights[side] > 0.25 * (measures_.patch - now.arc)) continue;
    pass_node(moment, now, side);
    return;
  }
}

/// What happens between two steps: nodes go round the axle, string and axle part or meet.
void ChainPlant::settle(Moment& moment) const {
  ChainState& chain = moment.chain;
  if (chain.touching) {
    const Bight now = bight(moment);
    const double nearest = std::max(0.5 * (measures_.patch - now.arc), kNearestNode);
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t node = chain.bight + side;
      const bool is_tip = node == 0 || node + 1 == chain.places.size();
      if (is_tip && now.straights[side] < kNearestTip)
        throw std::domain_error("a stick tip touches the axle");
      const Vec3 relative = chain.velocities[node] - moment.state.col(kVelocity);
      if (is_tip || !(now.straights[side] < nearest) || !(now.directions[side].dot(relative) < 0.0)) continue;
      pass_node(moment, now, side);
      break;
    }
    chain.touching = now.wrap > 0.0;
  } else {
    touch(moment);
  }
  if (!chain.touching) {
    chain.tensions = {};
    chain.slip = chain.pull = 0.0;
  }
  if (chain.pull > kTautPull) {
    moment.mode = Mode::kOnString;
  } else {
    const double height = height_above(ends(moment), moment.state.col(kPosition));
    moment.mode = height > (chain.touching ? kReleaseHeight : 0.0) ? Mode::kFlying : Mode::kLoose;
  }
}

}  // namespace plant
