// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>
#include <string>

#include "chain.hpp"

namespace plant {

/// Forces at rest [N] on the nodes and on the axle, with shares of the full friction and stiffness; where a
/// tip is rigid, how far it is from its place [m].
Eigen::VectorXd ChainPlant::forces(const Moment& moment, const Easing& easing) const {
  const ChainState& chain = moment.chain;
  const Pair<Stick> sticks = motion_.at(moment.time);
  const Bight around = bight(moment);
  const std::vector<Spring> springs = this->springs(moment, around, sticks);
  const Eigen::Index last = 3 * static_cast<Eigen::Index>(springs.size());
  Eigen::VectorXd forces(last + 6);
  for (Eigen::Index i = 0; i <= last; i += 3)
    forces.segment<3>(i) = measures_.node_mass * parameters_.gravity;
  forces.tail<3>() = parameters_.diabolo.mass * parameters_.gravity;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const Spring& spring = springs[i];
    const Eigen::Index row = 3 * static_cast<Eigen::Index>(i);
    const double tension = easing.stiffness * spring.stiffness * spring.excess;
    Pair<Vec3> pulls{tension * spring.pulls[0], tension * spring.pulls[1]};
    if (i == chain.bight) {
      const double half = 0.5 * easing.friction * tension * resting_friction(moment, around);
      pulls[0] -= half * spring.pulls[0];
      pulls[1] += half * spring.pulls[1];
      forces.tail<3>() += pulls[0] + pulls[1];
    }
    forces.segment<3>(row) -= pulls[0];
    forces.segment<3>(row + 3) -= pulls[1];
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const Vec3 bend = (side == 0 ? chain.places.front() : chain.places.back()) - sticks[side].tip;
    auto force = forces.segment<3>(side == 0 ? 0 : last);
    if (const auto& stiffness = parameters_.sticks.bending_stiffness) {
      const Vec3 weight = (parameters_.sticks.tip_mass - measures_.node_mass) * parameters_.gravity;
      force = perpendicular_part(Vec3(force) + weight, sticks[side].direction) - *stiffness * bend;
    } else {
      force = bend;
    }
  }
  return forces;
}

/// Newton's method on the forces at rest. Friction is brought in by and by on a soft string, which is then
/// stiffened.
Moment ChainPlant::hanging(Moment moment) const {
  constexpr double kDifference = 1e-8;     // of the Jacobian [m]
  constexpr double kLongestChange = 0.01;  // of an iteration, all places together [m]
  // All together [N]; rounding of the lengths leaves the more, the stiffer the string is.
  const double smallest_force = 1e-7 + 1e-11 * parameters_.string.stiffness;
  constexpr int kIterations = 400;
  constexpr double kFrictionStep = 0.1;
  constexpr double kSoft = 1000.0;  // EA to begin with [N]

  const Pair<Vec3> tips = ends(moment);
  const double distance = (tips[1] - tips[0]).norm();
  if (!(distance < parameters_.string.length - measures_.patch)) {
    throw std::invalid_argument("motion: the tips start " + std::to_string(distance) +
                                " m apart, expected less than the string's length");
  }
  // Below the middle, where the weight stretches the string about as much as it should.
  const double weight = parameters_.diabolo.mass * parameters_.gravity.norm();
  const double stiffness = std::min(kSoft, parameters_.string.stiffness);
  Easing easing{0.0, stiffness / parameters_.string.stiffness};
  const double wanted = parameters_.string.length * (1.0 + 0.6 * weight / stiffness);
  double low = 0.0;
  double high = wanted;
  for (int i = 0; i < 60; ++i) {
    const double sag = 0.5 * (low + high);
    moment.state.col(kPosition) = 0.5 * (tips[0] + tips[1]) - sag * up();
    const Bight tight = bight_around({moment.state.col(kPosition), moment.state.col(kAxis), moment.chirality},
                                     parameters_.diabolo.groove, measures_.contact_radius, tips);
    (tight.length() < wanted ? low : high) = sag;
  }
  lay_around_axle(moment);

  const auto place = [](Moment& at, Eigen::Index i) -> double& {
    const auto node = static_cast<std::size_t>(i / 3);
    return node < at.chain.places.size() ? at.chain.places[node](i % 3) : at.state(i % 3, kPosition);
  };
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::VectorXd force = forces(moment, easing);
    if (force.norm() < smallest_force) {
      if (easing.friction == 1.0 && easing.stiffness == 1.0) return moment;
      if (easing.friction < 1.0) {
        easing.friction = std::min(1.0, easing.friction + kFrictionStep);
      } else {
        easing.stiffness = std::min(1.0, 2.0 * easing.stiffness);
      }
      continue;
    }
    Eigen::MatrixXd jacobian(force.size(), force.size());
    for (Eigen::Index i = 0; i < force.size(); ++i) {
      Moment shifted = moment;
      place(shifted, i) += kDifference;
      jacobian.col(i) = (forces(shifted, easing) - force) / kDifference;
    }
    Eigen::VectorXd change = -jacobian.partialPivLu().solve(force);
    change *= std::min(1.0, kLongestChange / change.norm());
    for (Eigen::Index i = 0; i < force.size(); ++i) place(moment, i) += change(i);
    make_way(moment);
  }
  throw std::invalid_argument(
      "motion: the diabolo finds no place to hang at rest between the tips' first positions");
}

}  // namespace plant
