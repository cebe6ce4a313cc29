// SPDX-License-Identifier: MIT
#include "bight.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plant {
namespace {

constexpr double kNearest = 1e-4;  // shortest straight piece, in contact radii and in metres alike

/// How far along the axis the string lies: where the groove's cross-section is normal to its pull [m].
double shift_along_axis(const Axle& axle, const Groove& groove, const Pair<Vec3>& nodes) {
  const Vec3 pull = (nodes[0] - axle.centre).normalized() + (nodes[1] - axle.centre).normalized();
  const double strength = pull.norm();
  if (!(strength > 0.0)) return groove.offset;
  return groove.offset + std::clamp(groove.profile_radius * pull.dot(axle.axis) / strength,
                                    -groove.half_width, groove.half_width);
}

}  // namespace

Bight bight_around(const Axle& axle, const Groove& groove, double contact_radius, const Pair<Vec3>& nodes) {
  const Vec3 middle = (axle.aside + shift_along_axis(axle, groove, nodes)) * axle.axis;
  Bight bight;
  Pair<Vec3> normals;
  for (std::size_t side = 0; side < 2; ++side) {
    const Vec3 to_node = nodes[side] - axle.centre - middle;
    const Vec3 across = perpendicular_part(to_node, axle.axis);
    const double distance = std::max(across.norm(), (1.0 + kNearest) * contact_radius + 1e-12);
    const Vec3 towards = across / distance;
    const double cosine = contact_radius / distance;
    const double sine = (side == 0 ? axle.chirality : -axle.chirality) * std::sqrt(1.0 - cosine * cosine);
    normals[side] = cosine * towards + sine * axle.axis.cross(towards);
    bight.arms[side] = middle + contact_radius * normals[side];
    const Vec3 straight = to_node - contact_radius * normals[side];
    bight.straights[side] = std::max(straight.norm(), kNearest * kNearest);
    bight.directions[side] = straight / bight.straights[side];
  }
  const double angle =
      axle.chirality * std::atan2(axle.axis.dot(normals[0].cross(normals[1])), normals[0].dot(normals[1]));
  bight.wrap = angle < -0.5 * std::numbers::pi ? angle + 2.0 * std::numbers::pi : angle;
  bight.arc = contact_radius * bight.wrap;
  return bight;
}

}  // namespace plant
