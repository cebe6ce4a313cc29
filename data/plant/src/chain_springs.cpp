// SPDX-License-Identifier: MIT
#include "chain.hpp"

namespace plant {

Bight ChainPlant::bight(const Moment& moment) const {
  const std::size_t left = moment.chain.bight;
  return bight_around(
      {moment.state.col(kPosition), moment.state.col(kAxis), moment.chirality, moment.chain.aside},
      parameters_.diabolo.groove, measures_.contact_radius,
      {moment.chain.places[left], moment.chain.places[left + 1]});
}

/// How a node gives way to a pull: tips only across their sticks, and not at all where these are rigid.
Vec3 ChainPlant::yield(std::size_t node, const Vec3& pull, const Pair<Stick>& sticks) const {
  const bool is_left = node == 0;
  if (!is_left && node != static_cast<std::size_t>(parameters_.string.segments))
    return pull / measures_.node_mass;
  if (!parameters_.sticks.bending_stiffness) return Vec3::Zero();
  return perpendicular_part(pull, sticks[is_left ? 0 : 1].direction) / parameters_.sticks.tip_mass;
}

std::vector<Spring> ChainPlant::springs(const Moment& moment, const Bight& bight,
                                        const Pair<Stick>& sticks) const {
  const StringParameters& string = parameters_.string;
  const ChainState& chain = moment.chain;
  std::vector<Spring> springs(static_cast<std::size_t>(string.segments));
  for (std::size_t i = 0; i < springs.size(); ++i) {
    Spring& spring = springs[i];
    const double rest = measures_.rest(i == chain.bight);
    double length = bight.length();
    if (chain.touching && i == chain.bight) {
      spring.pulls = bight.directions;
      spring.axle_yield =
          (bight.directions[0] + bight.directions[1]).squaredNorm() / parameters_.diabolo.mass;
    } else {
      const Vec3 along = chain.places[i + 1] - chain.places[i];
      length = along.norm();
      spring.pulls = {-along / length, along / length};
    }
    spring.yields = {yield(i, spring.pulls[0], sticks), yield(i + 1, spring.pulls[1], sticks)};
    spring.excess = length - rest;
    spring.stiffness = string.stiffness / rest;
    spring.damping = string.damping * string.length / rest;
  }
  return springs;
}

void ChainPlant::measure_rates(const Moment& moment, double Spring::*rate,
                               std::vector<Spring>& springs) const {
  const ChainState& chain = moment.chain;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const Pair<Vec3>& pulls = springs[i].pulls;
    springs[i].*rate = pulls[0].dot(chain.velocities[i]) + pulls[1].dot(chain.velocities[i + 1]);
  }
  if (chain.touching) {
    Spring& spring = springs[chain.bight];
    spring.*rate -= (spring.pulls[0] + spring.pulls[1]).dot(moment.state.col(kVelocity));
  }
}

}  // namespace plant
