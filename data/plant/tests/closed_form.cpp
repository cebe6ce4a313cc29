// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "support.hpp"

using namespace plant;

namespace {

constexpr double kInterval = 2e-3;  // over which accelerations are averaged [s]: several periods of ringing

/// A thin axle on a string as stiff and as damped as the step allows: near the inextensible limit.
PlantParameters stiff(double friction) {
  PlantParameters parameters = lossless();
  parameters.string.stiffness = 2e5;
  parameters.string.damping = 150.0;
  parameters.string.friction = friction;
  parameters.string.radius = 0.0;
  parameters.diabolo.groove.radius = 1e-4;
  parameters.diabolo.groove.profile_radius = 0.0;
  return parameters;
}

Motion beating_hands() {
  MotionBuilder motion(SticksPose{});
  motion.oscillate({Vec3(0.0, 0.03, 0.06), Vec3(0.0, 0.02, -0.04)}, 1.2, 3.0);
  return motion.finish({}, 0);
}

/// Acceleration by the inextensible string's closed solution: along the bisector from the constraint, across
/// it in the strands' plane from gravity and capstan friction.
Vec3 closed_form(const PlantParameters& parameters, const Moment& moment, const Pair<Stick>& sticks,
                 double slip_sign) {
  Pair<Vec3> directions;
  double pull = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const Vec3 strand = sticks[side].tip - Vec3(moment.state.col(kPosition));
    directions[side] = strand.normalized();
    const Vec3 relative = sticks[side].velocity - Vec3(moment.state.col(kVelocity));
    pull += sticks[side].acceleration.dot(directions[side]) +
            perpendicular_part(relative, directions[side]).squaredNorm() / strand.norm();
  }
  const Vec3 sum = directions[0] + directions[1];
  const Vec3 normal = sum.normalized();
  const Vec3 tangent = (directions[1] - directions[0]).normalized();  // towards the right tip
  const double cosine = 0.5 * sum.norm();
  const double half_angle = std::acos(cosine);
  const double wrap = std::numbers::pi - 2.0 * half_angle;
  const Vec3& gravity = parameters.gravity;
  // Slip towards the right tip makes the right tension the greater one by exp(mu beta).
  const double lean = slip_sign * std::tanh(0.5 * parameters.string.friction * wrap) * std::tan(half_angle);
  const double load = pull / (2.0 * cosine) - gravity.dot(normal);
  // The constraint fixes the acceleration's share along the bisector; friction only adds along the tangent.
  return gravity + load * normal + lean * load * tangent;
}

/// Largest distance [m/s^2] between mean acceleration and closed form, and largest acceleration by friction.
Vec3 compare(double friction, double spin) {
  const PlantParameters parameters = stiff(friction);
  const StrandsPlant plant(parameters, beating_hands());
  Start start;
  start.spin = spin;
  Vec3 largest = Vec3::Zero();
  const auto at = [&](double middle) {
    return simulate(plant, start, {middle - 0.5 * kInterval, middle, middle + 0.5 * kInterval});
  };
  for (const double middle : {0.5, 0.7, 0.9, 1.1, 1.3, 1.5}) {
    const std::vector<Moment> moments = at(middle);
    for (const Moment& moment : moments) REQUIRE(moment.mode == Mode::kOnString);
    const Vec3 mean = (moments[2].state.col(kVelocity) - moments[0].state.col(kVelocity)) / kInterval;
    const double slip = plant.read(moments[1]).slip;
    PlantParameters without = parameters;
    without.string.friction = 0.0;
    const Pair<Stick> sticks = plant.motion().at(middle);
    const Vec3 expected = closed_form(parameters, moments[1], sticks, slip > 0.0 ? 1.0 : -1.0);
    const Vec3 unrubbed = closed_form(without, moments[1], sticks, 1.0);
    largest = largest.cwiseMax(
        Vec3((mean - expected).norm(), (expected - unrubbed).norm(), (expected - parameters.gravity).norm()));
  }
  return largest;
}

}  // namespace

TEST_CASE("a stiff frictionless string accelerates the diabolo as the inextensible one does") {
  const Vec3 found = compare(0.0, 0.0);
  INFO("error " << found.x() << ", by the string " << found.z() << " m/s^2");
  CHECK(found.z() > 9.0);
  CHECK(found.x() < 1e-3);
}

TEST_CASE("friction adds load * tanh(mu beta / 2) * tan(eta) along the tangent, with the sense of slip") {
  // The axle is so thin that its surface hardly moves: slip is the string's own speed over it.
  const Vec3 found = compare(0.3, 0.0);
  INFO("error " << found.x() << ", by friction " << found.y() << " m/s^2");
  CHECK(found.y() > 1.0);
  CHECK(found.x() < 3e-3);
}
