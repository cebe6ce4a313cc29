// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "support.hpp"

using namespace plant;

TEST_CASE("without gravity and friction a stiff string keeps the sum of distances and the speed") {
  PlantParameters parameters = lossless();
  parameters.gravity.setZero();
  parameters.string.stiffness = 1e5;
  parameters.string.damping = 5.0;
  parameters.string.radius = 0.0;
  parameters.diabolo.groove.radius = 1e-6;
  const StrandsPlant plant(parameters, still_hands({0.0, 0.3, 1.25}, {0.0, -0.3, 1.25}));
  // At the lowest point the string must bend the path: m v^2 b / a^2 along the bisector, half by each strand.
  constexpr double kSpeed = 1.5;
  const double major = 0.5 * parameters.string.length;
  const double minor = std::sqrt(major * major - 0.3 * 0.3);
  const double tension =
      parameters.diabolo.mass * kSpeed * kSpeed * minor / (major * major) / (2.0 * minor / major);
  const double stretch = tension * parameters.string.length / parameters.string.stiffness;
  const Start start = on_ellipse(parameters, plant.motion(), stretch, 0.0, {0.0, kSpeed, 0.0});

  double longest = 0.0;
  double slowest = kSpeed;
  double fastest = kSpeed;
  for (const Moment& moment : simulate(plant, start, times_until(1.0, 500))) {
    const Reading reading = plant.read(moment);
    REQUIRE(moment.mode == Mode::kOnString);
    const Vec3 centre = moment.state.col(kPosition);
    const double sum = (reading.tips[0] - centre).norm() + (reading.tips[1] - centre).norm();
    longest = std::max(longest, std::abs(sum - parameters.string.length));
    slowest = std::min(slowest, moment.state.col(kVelocity).norm());
    fastest = std::max(fastest, moment.state.col(kVelocity).norm());
  }
  CHECK(longest < 3.0 * stretch);
  CHECK(longest > 0.0);
  CHECK(fastest - slowest < 1e-3 * kSpeed);
}

TEST_CASE("a wrapped axle rolls down a vertical string at g / (1 + I / (m r^2))") {
  PlantParameters parameters = airless();
  parameters.string.stiffness = 2e4;
  parameters.string.wraps = 1;
  parameters.string.slip_scale = GENERATE(0.01, 0.002);
  const double lever = parameters.diabolo.groove.radius + parameters.string.radius;
  const double pretension_stretch = 6.0 * parameters.string.length / parameters.string.stiffness;
  const double distance = parameters.string.length + pretension_stretch - 2.0 * std::numbers::pi * lever;
  const StrandsPlant plant(parameters,
                           still_hands({0.0, 0.0, 1.25 + 0.5 * distance}, {0.0, 0.0, 1.25 - 0.5 * distance}));
  Start start;
  start.spin = 0.0;
  // Which side of the string the axle hangs on follows from the sense in which the string runs around it.
  start.position = Vec3(0.0, -lever, 1.25);
  const std::vector<Moment> moments = simulate(plant, start, {0.0, 0.1, 0.5});
  REQUIRE(moments.size() == 3);
  REQUIRE(moments.back().mode == Mode::kOnString);
  const double inertia = parameters.diabolo.axial_inertia / (parameters.diabolo.mass * lever * lever);
  const double acceleration =
      (moments[2].state(2, kVelocity) - moments[1].state(2, kVelocity)) / (moments[2].time - moments[1].time);
  CHECK(acceleration == Approx(-9.80665 / (1.0 + inertia)).epsilon(2e-3));
}

TEST_CASE("shifted tips tilt the axis at the rate of their torque over the spin") {
  PlantParameters parameters = lossless();
  parameters.diabolo.groove.profile_radius = 0.0;
  constexpr double kShift = 0.05;
  double slower = 0.0;
  for (const double spin : {150.0, 300.0}) {
    // One hand forward and one back turn the axis up or down.
    const StrandsPlant plant(parameters, still_hands({kShift, 0.3, 1.25}, {-kShift, -0.3, 1.25}));
    Start start;
    start.spin = spin;
    const std::vector<Moment> moments = simulate(plant, start, times_until(0.5, 500));
    const Reading reading = plant.read(moments.front());
    const double lever = parameters.diabolo.groove.radius + parameters.string.radius;
    const double half_angle = 0.5 * (std::numbers::pi - reading.wrap);
    const double strand =
        std::hypot(0.5 * (parameters.string.length + reading.stretch - lever * reading.wrap), 0.0);
    const double torque = 2.0 * lever * reading.tensions.left * kShift / strand * std::cos(half_angle);
    const double expected = torque / (parameters.diabolo.axial_inertia * spin);
    // A straight line through the nutation.
    double slope = 0.0;
    double weight = 0.0;
    for (const Moment& moment : moments) {
      slope += (moment.time - 0.25) * std::asin(moment.state(2, kAxis));
      weight += (moment.time - 0.25) * (moment.time - 0.25);
    }
    slope /= weight;
    CHECK(std::abs(slope) == Approx(expected).epsilon(0.01));
    if (slower != 0.0) CHECK(slope == Approx(0.5 * slower).epsilon(0.01));
    slower = slope;
  }
}

TEST_CASE("a groove beside the centre of mass yaws the axis as a heavy top, at m g d / (I w)") {
  PlantParameters parameters = lossless();
  parameters.diabolo.groove.profile_radius = 0.0;
  for (const double offset : {0.001, -0.002}) {
    parameters.diabolo.groove.offset = offset;
    const StrandsPlant plant(parameters, still_hands({0.0, 0.3, 1.25}, {0.0, -0.3, 1.25}));
    Start start;
    start.spin = 200.0;
    const std::vector<Moment> moments = simulate(plant, start, times_until(0.5, 500));
    const DiaboloParameters& diabolo = parameters.diabolo;
    // The spin about the axis is -w: momentum -I w s, torque of the weight about the groove -d s x (-m g z).
    const double expected = offset * diabolo.mass * 9.80665 / (diabolo.axial_inertia * start.spin);
    double slope = 0.0;
    double weight = 0.0;
    for (const Moment& moment : moments) {  // a straight line through the nutation
      slope += (moment.time - 0.25) * std::asin(moment.state(1, kAxis));
      weight += (moment.time - 0.25) * (moment.time - 0.25);
    }
    CHECK(slope / weight == Approx(expected).epsilon(0.02));
  }
}
