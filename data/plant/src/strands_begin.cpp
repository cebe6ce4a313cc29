// SPDX-License-Identifier: MIT
#include "strands.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace plant {

/// Newton's method on the forces at rest: hanging position and bends of the sticks.
void StrandsPlant::hang(Moment& moment) const {
  constexpr double kDifference = 1e-7;     // of the Jacobian [m]
  constexpr double kLongestChange = 0.02;  // of an iteration [m]
  constexpr double kSmallestForce = 1e-8;  // [m/s^2], all accelerations together
  constexpr int kIterations = 200;

  // Each unknown with the rate of state that must vanish.
  std::vector<std::pair<int, int>> unknowns{{kPosition, kVelocity}};
  if (parameters_.sticks.bending_stiffness) {
    for (std::size_t side = 0; side < 2; ++side) unknowns.emplace_back(kBend[side], kBendRate[side]);
  }
  const Pair<Stick> sticks = motion_.at(moment.time);
  const Eigen::Index size = 3 * static_cast<Eigen::Index>(unknowns.size());
  const auto accelerations = [&](const State& state) {
    const State change = rate(moment, moment.time, state, sticks);
    Eigen::VectorXd result(size);
    Eigen::Index row = 0;
    for (const auto& [place, acceleration] : unknowns) {
      result.segment<3>(row) = change.col(acceleration);
      row += 3;
    }
    return result;
  };

  const double half_distance = 0.5 * (sticks[1].tip - sticks[0].tip).norm();
  const double half_length = 0.5 * parameters_.string.length - parameters_.diabolo.groove.radius;
  if (!(half_distance < half_length)) {
    throw std::invalid_argument("motion: the tips start " + std::to_string(2.0 * half_distance) +
                                " m apart, expected less than the string's length");
  }
  const double sag = std::sqrt(half_length * half_length - half_distance * half_distance);
  moment.state.col(kPosition) = 0.5 * (sticks[0].tip + sticks[1].tip) - sag * up();

  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::VectorXd force = accelerations(moment.state);
    if (force.norm() < kSmallestForce) {
      moment.wrap_reference = shape(moment, moment.state, sticks).wrap;
      return;
    }
    Eigen::MatrixXd jacobian(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      State shifted = moment.state;
      shifted(i % 3, unknowns[static_cast<std::size_t>(i / 3)].first) += kDifference;
      jacobian.col(i) = (accelerations(shifted) - force) / kDifference;
    }
    Eigen::VectorXd change = -jacobian.partialPivLu().solve(force);
    change *= std::min(1.0, kLongestChange / change.norm());
    for (Eigen::Index i = 0; i < size; ++i) {
      moment.state(i % 3, unknowns[static_cast<std::size_t>(i / 3)].first) += change(i);
    }
  }
  throw std::invalid_argument(
      "motion: the diabolo finds no place to hang at rest between the tips' first positions");
}

Moment StrandsPlant::begin(const Start& start) const {
  const Pair<Stick> sticks = motion_.at(0.0);
  const Vec3 axis = direction_from_angles(start.yaw, start.pitch);
  Moment moment;
  moment.state.col(kAxis) = axis;
  moment.state.col(kReference) = axis.cross(Vec3(-std::sin(start.yaw), std::cos(start.yaw), 0.0));
  moment.state.col(kAngularMomentum) = -parameters_.diabolo.axial_inertia * start.spin * axis;
  moment.chirality = axis.dot((sticks[1].tip - sticks[0].tip).cross(up())) > 0.0 ? 1.0 : -1.0;
  moment.wrap_reference = 2.0 * std::numbers::pi * parameters_.string.wraps + 0.5 * std::numbers::pi;
  if (!start.position) {
    hang(moment);
    return moment;
  }
  moment.state.col(kPosition) = *start.position;
  moment.state.col(kVelocity) = start.velocity;
  if (start.flying) {
    moment.mode = Mode::kFlying;
  } else {
    const StringShape now = shape(moment, moment.state, sticks);
    moment.wrap_reference = now.wrap;
    moment.mode = is_taut(now, moment.time) ? Mode::kOnString : Mode::kLoose;
  }
  return moment;
}

}  // namespace plant
