// SPDX-License-Identifier: MIT
#include <algorithm>

#include "chain.hpp"
#include "hanging_curve.hpp"

namespace plant {
namespace {

constexpr double kMostWrapDrawn = 1.1 * std::numbers::pi;  // by the axle [rad]

}  // namespace

/// Lays the string between the tips as it hangs without a diabolo.
void ChainPlant::lay(Moment& moment) const {
  ChainState& chain = moment.chain;
  const Pair<Vec3> tips = ends(moment);
  const double length = parameters_.string.length;
  chain.touching = false;
  chain.bight = measures_.bight_at(0.5 * length);
  for (Vec3& velocity : chain.velocities) velocity.setZero();
  const HangingCurve curve(tips[0], tips[1], length, up());
  for (std::size_t i = 0; i < chain.places.size(); ++i) {
    chain.places[i] = curve.at(measures_.coordinate(i, chain.bight) / length);
  }
}

/// Lays it from the tips around the axle: stretched evenly, or sagging evenly on both sides. It moves with
/// the axle, but not along itself.
void ChainPlant::lay_around_axle(Moment& moment) const {
  ChainState& chain = moment.chain;
  const Pair<Vec3> tips = ends(moment);
  const double length = parameters_.string.length;
  const Vec3 centre = moment.state.col(kPosition);
  const Bight tight = bight_around({centre, moment.state.col(kAxis), moment.chirality},
                                   parameters_.diabolo.groove, measures_.contact_radius, tips);
  const double stretch = tight.length() / length;
  const double slack = std::max(0.0, length - tight.length());
  Pair<double> strands;
  for (std::size_t side = 0; side < 2; ++side) {
    strands[side] = tight.straights[side] / std::max(stretch, 1.0) + 0.5 * slack;
  }
  chain.touching = true;
  chain.bight = measures_.bight_at(strands[0] + 0.5 * (length - strands[0] - strands[1]));
  for (std::size_t i = 0; i < chain.places.size(); ++i) {
    const std::size_t side = i <= chain.bight ? 0 : 1;
    const double coordinate = measures_.coordinate(i, chain.bight);
    const double share = (side == 0 ? coordinate : length - coordinate) / strands[side];
    chain.places[i] = HangingCurve(tips[side], centre + tight.arms[side], strands[side], up()).at(share);
    chain.velocities[i] = share * perpendicular_part(moment.state.col(kVelocity), tight.directions[side]);
  }
}

/// The tensions beside the axle as the stretch gives them.
void ChainPlant::read_pull(Moment& moment) const {
  ChainState& chain = moment.chain;
  const Bight around = bight(moment);
  const Spring spring = springs(moment, around, motion_.at(moment.time))[chain.bight];
  chain.pull = std::max(0.0, spring.stiffness * spring.excess);
  chain.slip = slip(moment, around);
  const double half = 0.5 * chain.pull * resting_friction(moment, around);
  chain.tensions = {chain.pull - half, chain.pull + half};
}

Moment ChainPlant::begin(const Start& start) const {
  const Pair<Stick> sticks = motion_.at(0.0);
  const Vec3 axis = direction_from_angles(start.yaw, start.pitch);
  Moment moment;
  moment.state.col(kAxis) = axis;
  moment.state.col(kReference) = axis.cross(Vec3(-std::sin(start.yaw), std::cos(start.yaw), 0.0));
  moment.state.col(kAngularMomentum) = -parameters_.diabolo.axial_inertia * start.spin * axis;
  moment.chirality = axis.dot((sticks[1].tip - sticks[0].tip).cross(up())) > 0.0 ? 1.0 : -1.0;
  moment.chain.places.assign(static_cast<std::size_t>(parameters_.string.segments) + 1, Vec3::Zero());
  moment.chain.velocities = moment.chain.places;
  moment.chain.places.front() = sticks[0].tip;
  moment.chain.places.back() = sticks[1].tip;
  if (!start.position) {
    moment = hanging(moment);
    read_pull(moment);
    return moment;
  }
  moment.state.col(kPosition) = *start.position;
  moment.state.col(kVelocity) = start.velocity;
  moment.mode = Mode::kFlying;
  if (start.flying) {
    lay(moment);
  } else {
    lay_around_axle(moment);
    const double wrap = bight(moment).wrap;
    if (wrap > 0.0 && wrap < kMostWrapDrawn) {
      read_pull(moment);
    } else {
      lay(moment);  // so slack that it hangs free of the axle
    }
    settle(moment);
  }
  return moment;
}

}  // namespace plant
