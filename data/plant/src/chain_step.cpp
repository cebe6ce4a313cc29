// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "chain.hpp"

namespace plant {
namespace {

constexpr double kSlideTime = 0.01;  // in which a string that was caught on a cup slides into the groove [s]
constexpr double kPullTime = 0.005;  // over which the string's pull is smoothed to tell slack from taut [s]

Vec3 rotated(const Vec3& vector, const Vec3& axis, double angle) {
  const Vec3 along = vector.dot(axis) * axis;
  return along + rotate_in_plane(vector - along, axis, angle);
}

/// Free rotation of a symmetric top, which is exact: the axis circles the angular momentum.
void rotate(const DiaboloParameters& diabolo, double step, State& state) {
  const double spin = spin_about_axis(diabolo, state);
  const Vec3 momentum = state.col(kAngularMomentum);
  const double strength = momentum.norm();
  state(0, kPhase) += step * spin * (1.0 - 1.0 / diabolo.inertia_ratio);
  if (!(strength > 0.0)) return;
  const double angle = step * strength / (diabolo.axial_inertia * diabolo.inertia_ratio);
  const Vec3 axis = rotated(state.col(kAxis), momentum / strength, angle).normalized();
  const Vec3 reference = rotated(state.col(kReference), momentum / strength, angle);
  state.col(kAxis) = axis;
  state.col(kReference) = perpendicular_part(reference, axis).normalized();
}

}  // namespace

void ChainPlant::drift(Moment& moment, double step) const {
  ChainState& chain = moment.chain;
  for (std::size_t i = 0; i < chain.places.size(); ++i) chain.places[i] += step * chain.velocities[i];
  moment.state.col(kPosition) += step * moment.state.col(kVelocity);
  rotate(parameters_.diabolo, step, moment.state);
}

/// Rigid tips go where the hands are; bent ones keep to them along their sticks.
void ChainPlant::place_tips(Moment& moment, const Pair<Stick>& sticks) const {
  ChainState& chain = moment.chain;
  for (std::size_t side = 0; side < 2; ++side) {
    const Stick& stick = sticks[side];
    Vec3& place = side == 0 ? chain.places.front() : chain.places.back();
    Vec3& velocity = side == 0 ? chain.velocities.front() : chain.velocities.back();
    const bool bends = parameters_.sticks.bending_stiffness.has_value();
    const Vec3 bend = bends ? perpendicular_part(place - stick.tip, stick.direction) : Vec3(Vec3::Zero());
    const Vec3 bend_rate =
        bends ? perpendicular_part(velocity - stick.velocity, stick.direction) : Vec3(Vec3::Zero());
    place = stick.tip + bend;
    velocity = stick.velocity + bend_rate;
    moment.state.col(kBend[side]) = bend;
    moment.state.col(kBendRate[side]) = bend_rate;
  }
}

void ChainPlant::kick(Moment& moment, double step) const {
  const DiaboloParameters& diabolo = parameters_.diabolo;
  const Pair<Stick> sticks = motion_.at(moment.time + 0.5 * step);
  place_tips(moment, sticks);
  ChainState& chain = moment.chain;
  State& state = moment.state;
  const Bight around = chain.touching ? bight(moment) : Bight{};
  std::vector<Spring> springs = this->springs(moment, around, sticks);
  measure_rates(moment, &Spring::rate, springs);

  // All that does not come from the string.
  const Vec3 tips_velocity = 0.5 * (chain.velocities.front() + chain.velocities.back());
  const Meeting met = meeting(diabolo, state, moment.time + 0.5 * step, tips_velocity);
  state.col(kVelocity) += step * (parameters_.gravity + air_acceleration(parameters_.air, met));
  state.col(kAngularMomentum) += step *
                                 (windage_torque(parameters_.air, met.spin) +
                                  axle_torque(diabolo.axle_drag, diabolo.axial_inertia, met.spin) +
                                  gust_torque(parameters_.air, diabolo.axial_inertia, met.time)) *
                                 met.axis;
  straighten(moment, step);
  calm(moment, step);
  guide(moment);
  for (std::size_t i = 1; i + 1 < chain.velocities.size(); ++i)
    chain.velocities[i] += step * parameters_.gravity;
  if (const auto& stiffness = parameters_.sticks.bending_stiffness) {
    const double mass = parameters_.sticks.tip_mass;
    const double damping = 2.0 * parameters_.sticks.damping_ratio * std::sqrt(*stiffness * mass);
    for (std::size_t side = 0; side < 2; ++side) {
      const Vec3 force = -*stiffness * state.col(kBend[side]) - damping * state.col(kBendRate[side]);
      (side == 0 ? chain.velocities.front() : chain.velocities.back()) +=
          step * perpendicular_part(parameters_.gravity + force / mass, sticks[side].direction);
    }
  }

  // The string.
  measure_rates(moment, &Spring::free_rate, springs);
  const TensionSystem system(springs, step);
  std::vector<double> tensions = system.tensions();
  double difference = chain.touching && tensions[chain.bight] > 0.0
                          ? rub(moment, around, system, springs, step, tensions)
                          : 0.0;
  for (double& tension : tensions) tension = std::max(tension, 0.0);
  for (std::size_t i = 0; i < springs.size(); ++i) {
    chain.velocities[i] -= step * tensions[i] * springs[i].yields[0];
    chain.velocities[i + 1] -= step * tensions[i] * springs[i].yields[1];
  }
  if (!chain.touching) return;
  const std::size_t at = chain.bight;
  difference = std::clamp(difference, -2.0 * tensions[at], 2.0 * tensions[at]);
  chain.velocities[at] += 0.5 * step * difference * springs[at].yields[0];
  chain.velocities[at + 1] -= 0.5 * step * difference * springs[at].yields[1];
  chain.tensions = {tensions[at] - 0.5 * difference, tensions[at] + 0.5 * difference};
  const Vec3 left = chain.tensions.left * around.directions[0];
  const Vec3 right = chain.tensions.right * around.directions[1];
  state.col(kVelocity) += step / diabolo.mass * (left + right);
  state.col(kAngularMomentum) += step * (around.arms[0].cross(left) + around.arms[1].cross(right));
  chain.slip = slip(moment, around);
}

Moment ChainPlant::advanced(Moment moment, double step) const {
  if (moment.missed) return moment;
  drift(moment, 0.5 * step);
  kick(moment, step);
  drift(moment, 0.5 * step);
  moment.time += step;
  ChainState& chain = moment.chain;
  chain.pull += step / kPullTime * (0.5 * (chain.tensions.left + chain.tensions.right) - chain.pull);
  chain.aside *= 1.0 - step / kSlideTime;
  if (!moment.state.allFinite()) throw std::domain_error("the play diverges: too few steps per second");
  settle(moment);
  return moment;
}

}  // namespace plant
