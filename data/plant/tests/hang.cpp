// SPDX-License-Identifier: MIT
#include <cmath>

#include "support.hpp"

using namespace plant;

TEST_CASE("a diabolo at rest hangs by m g / (2 cos eta) per strand") {
  PlantParameters parameters = lossless();
  const StrandsPlant plant(parameters, still_hands({0.0, 0.35, 1.25}, {0.0, -0.35, 1.25}));
  Start start;
  start.spin = 0.0;
  for (const Moment& moment : simulate(plant, start, {0.0, 1.0})) {
    const Reading reading = plant.read(moment);
    const double half_angle = 0.5 * (std::numbers::pi - reading.wrap);
    const double expected = parameters.diabolo.mass * 9.80665 / (2.0 * std::cos(half_angle));
    CHECK(reading.tensions.left == Approx(expected).epsilon(1e-7));
    CHECK(reading.tensions.right == Approx(expected).epsilon(1e-7));
    CHECK(reading.stretch ==
          Approx(expected * parameters.string.length / parameters.string.stiffness).epsilon(1e-7));
    CHECK(moment.state.col(kVelocity).norm() < 1e-7);
    const Vec3 carried = reading.on_tips[0] + reading.on_tips[1];
    CHECK((carried + parameters.diabolo.mass * 9.80665 * Vec3::UnitZ()).norm() < 1e-6);  // by the tips
  }
}

TEST_CASE("friction of a spinning axle splits the tension by exp(mu beta) and leans the hang") {
  PlantParameters parameters = airless();
  const double spin = GENERATE(150.0, -150.0);
  const StrandsPlant plant(parameters, still_hands({0.0, 0.35, 1.25}, {0.0, -0.35, 1.25}));
  Start start;
  start.spin = spin;
  const Moment moment = simulate(plant, start, {0.5}).front();
  const Reading reading = plant.read(moment);
  const double ratio = spin > 0.0 ? reading.tensions.left / reading.tensions.right
                                  : reading.tensions.right / reading.tensions.left;
  CHECK(ratio == Approx(std::exp(parameters.string.friction * reading.wrap)).epsilon(1e-9));

  // The two tensions pull straight up in sum, away from the bisector by atan(tanh(mu beta / 2) tan eta).
  const Vec3 to_left = (reading.tips[0] - Vec3(moment.state.col(kPosition))).normalized();
  const Vec3 to_right = (reading.tips[1] - Vec3(moment.state.col(kPosition))).normalized();
  const Vec3 bisector = (to_left + to_right).normalized();
  const double lean = std::atan2(bisector.y(), bisector.z());
  const double half_angle = 0.5 * (std::numbers::pi - reading.wrap);
  const double expected =
      std::atan(std::tanh(0.5 * parameters.string.friction * reading.wrap) * std::tan(half_angle));
  // The strands leave a thick axle, so that directions from its centre agree to r / l only.
  CHECK(std::abs(std::abs(lean) - expected) < 0.01);
  CHECK(lean * spin < 0.0);
}

TEST_CASE("friction slows the spin by the torque of the two tensions") {
  PlantParameters parameters = airless();
  const StrandsPlant plant(parameters, still_hands({0.0, 0.05, 1.25}, {0.0, -0.05, 1.25}));
  Start start;
  start.spin = 150.0;
  const std::vector<Moment> moments = simulate(plant, start, {0.0, 1.0});
  const Tensions tensions = plant.read(moments.front()).tensions;
  const double lever = parameters.diabolo.groove.radius + parameters.string.radius;
  const double expected = lever * (tensions.right - tensions.left) / parameters.diabolo.axial_inertia;
  const double change = play_spin(parameters.diabolo, moments.back().state) -
                        play_spin(parameters.diabolo, moments.front().state);
  CHECK(change == Approx(expected).epsilon(1e-4));
  CHECK(change < -10.0);
}

TEST_CASE("a twisted string leans the hang along the axle by a part of its friction, with the slip's sign") {
  PlantParameters parameters = airless();
  const double lay = GENERATE(0.4, -0.4), spin = GENERATE(150.0, -150.0);
  parameters.string.lay = lay;
  const StrandsPlant plant(parameters, still_hands({0.0, 0.35, 1.25}, {0.0, -0.35, 1.25}));
  Start start;
  start.spin = spin;
  const Moment moment = simulate(plant, start, {0.0}).front();
  const Tensions tensions = plant.read(moment).tensions;
  // The axle points forwards; about it the string runs from the left tip to the right one with the sense -1.
  const double push = -lay * (tensions.right - tensions.left);
  CHECK(push * lay * spin > 0.0);
  CHECK(std::abs(push) > 0.3);
  const Vec3 position = moment.state.col(kPosition);
  // The strands leave a thick axle, 7 mm under its centre.
  CHECK(position.x() / (1.25 - position.z()) ==
        Approx(push / (parameters.diabolo.mass * 9.80665)).epsilon(0.015));
}

TEST_CASE("a one-way bearing leaves its own drag in one sense and the whole friction in the other") {
  PlantParameters parameters = airless();
  parameters.diabolo.bearing_torque = 5e-4;
  const StrandsPlant plant(parameters, still_hands({0.0, 0.05, 1.25}, {0.0, -0.05, 1.25}));
  for (const double spin : {150.0, -150.0}) {
    Start start;
    start.spin = spin;
    const std::vector<Moment> moments = simulate(plant, start, {0.0, 0.5});
    const double change = play_spin(parameters.diabolo, moments.back().state) -
                          play_spin(parameters.diabolo, moments.front().state);
    const double expected = -std::copysign(5e-4 / parameters.diabolo.axial_inertia, spin) * 0.5;
    CHECK(change == Approx(expected).epsilon(1e-6));
  }
}
