// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <vector>

#include "chain.hpp"

namespace plant {
namespace {

/// Tension of a segment [N].
double pull(const Spring& spring) {
  return spring.excess > 0.0 ? std::max(0.0, spring.stiffness * spring.excess + spring.damping * spring.rate)
                             : 0.0;
}

}  // namespace

Reading ChainPlant::read(const Moment& moment) const {
  const DiaboloParameters& diabolo = parameters_.diabolo;
  const StickParameters& stick = parameters_.sticks;
  const ChainState& chain = moment.chain;
  const State& state = moment.state;
  const Vec3& gravity = parameters_.gravity;
  const Pair<Stick> sticks = motion_.at(moment.time);

  Reading reading;
  reading.tips = stick.bending_stiffness ? ends(moment) : Pair<Vec3>{sticks[0].tip, sticks[1].tip};
  const Bight around = bight(moment);
  if (chain.touching) reading.wrap = around.wrap;
  reading.slip = chain.slip;
  reading.tensions = chain.tensions;
  // The stretch is that of the string drawn tight, however it sags.
  reading.stretch = std::numeric_limits<double>::quiet_NaN();
  if (moment.mode != Mode::kFlying) {
    const Axle axle{state.col(kPosition), state.col(kAxis), moment.chirality};
    reading.stretch = bight_around(axle, diabolo.groove, measures_.contact_radius, reading.tips).length() -
                      parameters_.string.length;
  }

  const Vec3 momentum = state.col(kAngularMomentum);
  const double along = momentum.dot(state.col(kAxis));
  const double across_squared = momentum.squaredNorm() - along * along;
  const auto moving = [&](double mass, const Vec3& place, const Vec3& velocity) {
    return mass * (0.5 * velocity.squaredNorm() - gravity.dot(place));
  };
  reading.energy = moving(diabolo.mass, state.col(kPosition), state.col(kVelocity)) +
                   0.5 * (along * along + across_squared / diabolo.inertia_ratio) / diabolo.axial_inertia;
  for (std::size_t i = 1; i + 1 < chain.places.size(); ++i) {
    reading.energy += moving(measures_.node_mass, chain.places[i], chain.velocities[i]);
  }
  std::vector<Spring> segments = springs(moment, around, sticks);
  measure_rates(moment, &Spring::rate, segments);
  for (const Spring& spring : segments) {
    if (spring.excess > 0.0) reading.energy += 0.5 * spring.stiffness * spring.excess * spring.excess;
  }
  reading.on_tips = {-pull(segments.front()) * segments.front().pulls[0],
                     -pull(segments.back()) * segments.back().pulls[1]};
  if (stick.bending_stiffness) {
    for (std::size_t side = 0; side < 2; ++side) {
      reading.energy += moving(stick.tip_mass, state.col(kBend[side]), state.col(kBendRate[side])) +
                        0.5 * *stick.bending_stiffness * state.col(kBend[side]).squaredNorm();
    }
  }
  return reading;
}

}  // namespace plant
