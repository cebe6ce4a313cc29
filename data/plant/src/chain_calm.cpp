// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "chain.hpp"

namespace plant {
namespace {

constexpr double kMostBending = 0.03;   // velocity taken from a kink per step, as a share; 1/16 would stop it
constexpr double kGuidingTime = 0.005;  // in which a cup's flank pushes the string back between the cups [s]

}  // namespace

/// Internal friction of a string that is bent to and fro: it calms kinks, but neither moves nor turns the
/// string as a whole. Not around the axle, and never more than the step can follow.
void ChainPlant::straighten(Moment& moment, double step) const {
  ChainState& chain = moment.chain;
  const double spacing = measures_.spacing;
  const double wanted = parameters_.string.bending_damping / (spacing * spacing * spacing);
  const double share = std::min(step * wanted / measures_.node_mass, kMostBending);
  const std::vector<Vec3> before = chain.velocities;
  for (std::size_t i = 1; i + 1 < before.size(); ++i) {
    if (chain.touching && (i == chain.bight || i == chain.bight + 1)) continue;
    const Vec3 change = share * (before[i - 1] - 2.0 * before[i] + before[i + 1]);
    chain.velocities[i] += 2.0 * change;
    if (i > 1) chain.velocities[i - 1] -= change;
    if (i + 2 < before.size()) chain.velocities[i + 1] -= change;
  }
}

/// Waves die out: each node is drawn towards the motion of a straight strand between the tip and the axle, or
/// between the tips, whose ends take the reaction. A taut string hardly feels it, whatever it does as a
/// whole.
void ChainPlant::calm(Moment& moment, double step) const {
  ChainState& chain = moment.chain;
  const std::size_t last = chain.places.size() - 1;
  const Vec3 axle = moment.state.col(kVelocity);
  const double rate = step * parameters_.string.wave_damping;
  Vec3 reaction = Vec3::Zero();
  for (std::size_t i = 1; i < last; ++i) {
    const bool is_left = i <= chain.bight;
    double share = static_cast<double>(i) / static_cast<double>(last);
    Vec3 straight = (1.0 - share) * chain.velocities[0] + share * chain.velocities[last];
    if (chain.touching) {
      share = is_left ? static_cast<double>(i) / (static_cast<double>(chain.bight) + 0.5)
                      : static_cast<double>(last - i) / (static_cast<double>(last - chain.bight) - 0.5);
      straight = share * axle + (1.0 - share) * chain.velocities[is_left ? 0 : last];
      // The string also runs along itself; only motion across the strand is a wave.
      const Vec3 along = (chain.places[is_left ? 0 : last] - Vec3(moment.state.col(kPosition))).normalized();
      const Vec3 change = rate * perpendicular_part(straight - chain.velocities[i], along);
      chain.velocities[i] += change;
      reaction -= share * change;
    } else {
      chain.velocities[i] += rate * (straight - chain.velocities[i]);
    }
  }
  moment.state.col(kVelocity) += measures_.node_mass / parameters_.diabolo.mass * reaction;
}

/// The cups' flanks keep a string that is between them there.
void ChainPlant::guide(Moment& moment) const {
  const DiaboloParameters& diabolo = parameters_.diabolo;
  ChainState& chain = moment.chain;
  const Vec3 centre = moment.state.col(kPosition);
  const Vec3 axis = moment.state.col(kAxis);
  const double radius = 0.5 * diabolo.diameter;
  const double half_length = 0.5 * diabolo.length;
  const double node_share = measures_.node_mass / (measures_.node_mass + diabolo.mass);
  for (std::size_t i = 1; i + 1 < chain.places.size(); ++i) {
    const Vec3 away = chain.places[i] - centre;
    if (!(away.squaredNorm() < radius * radius + half_length * half_length)) continue;
    const double offset = axis.dot(away);
    const double distance = perpendicular_part(away, axis).norm();
    const double gap =
        diabolo.groove.half_width + (half_length - diabolo.groove.half_width) * distance / radius;
    if (!(std::abs(offset) > gap && std::abs(offset) < half_length && distance < radius)) continue;
    const Vec3 relative = chain.velocities[i] - moment.state.col(kVelocity);
    const double outwards = std::copysign(1.0, offset) * axis.dot(relative);
    const double wanted = (gap - std::abs(offset)) / kGuidingTime;
    if (!(outwards > wanted)) continue;
    const Vec3 change = std::copysign(wanted - outwards, -offset) * axis;
    chain.velocities[i] += (1.0 - node_share) * change;
    moment.state.col(kVelocity) -= node_share * change;
  }
}

}  // namespace plant
