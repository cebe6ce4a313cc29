// SPDX-License-Identifier: MIT
#include "string.hpp"

#include <algorithm>
#include <stdexcept>

namespace plant {
namespace {

double friction_coefficient(const StringParameters& string, double slip) {
  const double ratio = slip / string.stribeck_speed;
  return string.friction + string.friction_rise * std::exp(-ratio * ratio);
}

/// (exp(x) - 1) / x, also at zero.
double mean_growth(double x) { return std::abs(x) < 1e-8 ? 1.0 + 0.5 * x : std::expm1(x) / x; }

}  // namespace

StringShape string_shape(const StringParameters& string, const Groove& groove, const StringEnds& ends) {
  const double contact_radius = groove.radius + string.radius;
  const Vec3& axis = ends.axis;

  // The string settles where the groove's cross-section is normal to the pull.
  const Vec3 bisector = (ends.tips[0] - ends.centre).normalized() + (ends.tips[1] - ends.centre).normalized();
  const double norm = bisector.norm();
  const double free_shift = norm > 0.0 ? groove.profile_radius * bisector.dot(axis) / norm : 0.0;
  const double shift = groove.offset + std::clamp(free_shift, -groove.half_width, groove.half_width);

  StringShape shape;
  shape.at_flank = std::abs(free_shift) > groove.half_width;
  Pair<Vec3> normals;
  Pair<double> flow;
  double turning = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const Vec3 to_tip = ends.tips[side] - ends.centre - shift * axis;
    const Vec3 across = perpendicular_part(to_tip, axis);
    const double distance = across.norm();
    if (!std::isfinite(distance)) throw std::domain_error("the play diverges: too few steps per second");
    if (!(distance > contact_radius)) throw std::domain_error("a stick tip touches the axle");
    const Vec3 towards = across / distance;
    const double sense = side == 0 ? ends.chirality : -ends.chirality;
    normals[side] = rotate_in_plane(towards, axis, sense * std::acos(contact_radius / distance));

    Strand& strand = shape.strands[side];
    strand.arm = shift * axis + contact_radius * normals[side];
    const Vec3 straight = ends.tips[side] - ends.centre - strand.arm;
    strand.length = straight.norm();
    strand.direction = straight / strand.length;

    const Vec3 relative = ends.tip_velocities[side] - ends.velocity;
    flow[side] = strand.direction.dot(relative);
    turning += 0.5 * axis.dot(towards.cross(perpendicular_part(relative, axis))) / distance;
  }

  const double angle =
      ends.chirality * std::atan2(axis.dot(normals[0].cross(normals[1])), normals[0].dot(normals[1]));
  constexpr double kTurn = 2.0 * std::numbers::pi;
  shape.wrap = angle + kTurn * std::round((ends.wrap_reference - angle) / kTurn);
  shape.arc = contact_radius * shape.wrap;
  shape.length = shape.strands[0].length + shape.strands[1].length + shape.arc;
  shape.rate = flow[0] + flow[1];
  shape.slip = 0.5 * (flow[1] - flow[0]) - ends.chirality * contact_radius * (ends.spin - turning);
  return shape;
}

Tensions string_tensions(const StringParameters& string, const StringShape& shape) {
  // Massless, so a single unknown: tension grows along the arc as exp(friction * angle) against the slip.
  const double growth =
      friction_coefficient(string, shape.slip) * shape.wrap * std::tanh(shape.slip / string.slip_scale);
  const double ratio = std::exp(growth);
  const double weight =
      (shape.strands[0].length + ratio * shape.strands[1].length + shape.arc * mean_growth(growth)) *
      string.length / shape.length;
  const double stretch = shape.length - string.length;
  const double left = (string.stiffness * stretch * (1.0 + stretch / string.stiffening_stretch) +
                       string.damping * string.length * (shape.rate - string.creep)) /
                      weight;
  return {left, ratio * left};
}

}  // namespace plant
