// SPDX-License-Identifier: MIT
#include <algorithm>

#include "chain.hpp"
#include "coulomb.hpp"

namespace plant {

/// Speed of the string over the axle's surface, positive towards the right tip [m/s].
double ChainPlant::slip(const Moment& moment, const Bight& bight) const {
  const std::size_t left = moment.chain.bight;
  const Vec3 velocity = moment.state.col(kVelocity);
  const double flow = bight.directions[1].dot(moment.chain.velocities[left + 1] - velocity) -
                      bight.directions[0].dot(moment.chain.velocities[left] - velocity);
  return 0.5 * flow -
         moment.chirality * measures_.contact_radius * spin_about_axis(parameters_.diabolo, moment.state);
}

/// Difference of the two tensions over their mean where nothing but the axle moves.
double ChainPlant::resting_friction(const Moment& moment, const Bight& bight) const {
  const double sliding = std::clamp(slip(moment, bight) / parameters_.string.slip_scale, -1.0, 1.0);
  return sliding * coulomb_share(parameters_.string.friction, bight.wrap);
}

/// Adds what friction does to the tensions and returns the difference of the two beside the axle [N]. All
/// answer in proportion to that difference: the nodes beside the axle, the axle, its spin, and through them
/// the tensions.
double ChainPlant::rub(const Moment& moment, const Bight& bight, const TensionSystem& system,
                       const std::vector<Spring>& springs, double step, std::vector<double>& tensions) const {
  const std::size_t at = moment.chain.bight;
  const double share = coulomb_share(parameters_.string.friction, bight.wrap);
  if (!(share > 0.0)) return 0.0;
  const Spring& spring = springs[at];
  const Vec3 across = bight.directions[1] - bight.directions[0];

  // One newton more at the right than at the left speeds the left node up by half of it, the right one down.
  std::vector<double> rate_changes(springs.size());
  const Vec3 left_change = 0.5 * step * spring.yields[0];
  const Vec3 right_change = -0.5 * step * spring.yields[1];
  rate_changes[at] = spring.pulls[0].dot(left_change) + spring.pulls[1].dot(right_change);
  if (at > 0) rate_changes[at - 1] = springs[at - 1].pulls[1].dot(left_change);
  if (at + 1 < springs.size()) rate_changes[at + 1] = springs[at + 1].pulls[0].dot(right_change);
  const std::vector<double> changes = system.response(rate_changes);

  // Slip that follows from tensions: only the two nodes beside the axle count, its own share cancels.
  const auto slip_of = [&](const std::vector<double>& pulls) {
    Vec3 left = pulls[at] * spring.yields[0];
    Vec3 right = pulls[at] * spring.yields[1];
    if (at > 0) left += pulls[at - 1] * springs[at - 1].yields[1];
    if (at + 1 < springs.size()) right += pulls[at + 1] * springs[at + 1].yields[0];
    return -0.5 * step * (bight.directions[1].dot(right) - bight.directions[0].dot(left));
  };
  const double lever = measures_.contact_radius;
  const double direct = 0.5 * bight.directions[1].dot(right_change) -
                        0.5 * bight.directions[0].dot(left_change) -
                        step * (0.25 * across.squaredNorm() / parameters_.diabolo.mass +
                                lever * lever / parameters_.diabolo.axial_inertia);
  const double difference =
      friction_difference(share, parameters_.string.slip_scale, {tensions[at], changes[at]},
                          {slip(moment, bight) + slip_of(tensions), direct + slip_of(changes)});
  for (std::size_t i = 0; i < tensions.size(); ++i) tensions[i] += difference * changes[i];
  return difference;
}

}  // namespace plant
