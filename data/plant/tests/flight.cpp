// SPDX-License-Identifier: MIT
#include <cmath>

#include "support.hpp"

using namespace plant;

TEST_CASE("a flight without air is a parabola with constant spin and angular momentum") {
  const StrandsPlant plant(airless(), kHands);
  Start start = thrown({0.3, -0.2, 4.0}, 150.0);
  start.pitch = 0.1;
  const Moment first = plant.begin(start);
  const Moment last = simulate(plant, start, {0.8}).front();
  const Vec3 expected = *start.position + 0.8 * start.velocity + 0.32 * plant.parameters().gravity;
  CHECK((Vec3(last.state.col(kPosition)) - expected).norm() < 1e-9);
  CHECK((last.state.col(kAngularMomentum) - first.state.col(kAngularMomentum)).norm() < 1e-15);
  CHECK(last.state(0, kPhase) == Approx(-150.0 * 0.8).epsilon(1e-9));
}

TEST_CASE("a tumbling axis circles the angular momentum at |L| / I_t") {
  const StrandsPlant plant(airless(), kHands);
  const Start start = thrown({0.0, 0.0, 4.0}, 100.0);
  Moment moment = plant.begin(start);
  moment.state.col(kAngularMomentum) += Vec3(0.0, 0.0, 0.01);
  const Vec3 momentum = moment.state.col(kAngularMomentum);
  const double period = 2.0 * std::numbers::pi * plant.parameters().diabolo.axial_inertia *
                        plant.parameters().diabolo.inertia_ratio / momentum.norm();
  const Vec3 axis = moment.state.col(kAxis);
  const int steps = 3000;
  Vec3 halfway = axis;
  for (int i = 0; i < steps; ++i) {
    if (i == steps / 2) halfway = moment.state.col(kAxis);
    moment = plant.advanced(moment, period / steps);
  }
  CHECK((Vec3(moment.state.col(kAxis)) - axis).norm() < 1e-8);
  CHECK((halfway - axis).norm() > 0.1);
}

TEST_CASE("drag, Magnus force and windage follow their closed forms") {
  PlantParameters parameters = airless();
  parameters.gravity.setZero();

  SECTION("quadratic drag") {
    parameters.air.drag = 0.03;
    const StrandsPlant plant(parameters, kHands);
    const Moment last = simulate(plant, thrown({0.0, 5.0, 0.0}, 0.0), {0.9}).front();
    CHECK(last.state(1, kVelocity) == Approx(5.0 / (1.0 + 0.03 * 5.0 * 0.9)).epsilon(1e-10));
    CHECK(last.state(1, kPosition) == Approx(std::log(1.0 + 0.03 * 5.0 * 0.9) / 0.03).epsilon(1e-10));
  }

  SECTION("linear drag") {
    parameters.air.linear_drag = 0.4;
    const StrandsPlant plant(parameters, kHands);
    const Moment last = simulate(plant, thrown({0.0, 5.0, 0.0}, 0.0), {0.9}).front();
    CHECK(last.state(1, kVelocity) == Approx(5.0 * std::exp(-0.4 * 0.9)).epsilon(1e-10));
  }

  SECTION("wind carries a diabolo at rest along, by either drag, and without drag does nothing") {
    parameters.air.wind = Vec3(2.0, -1.0, 0.0);
    const auto carried = [&] {
      return Vec3(simulate(StrandsPlant(parameters, kHands), thrown({0.0, 0.0, 0.0}, 0.0), {0.5})
                      .front()
                      .state.col(kVelocity));
    };
    CHECK(carried().norm() == 0.0);
    parameters.air.linear_drag = 0.4;
    const double share = 1.0 - std::exp(-0.4 * 0.5);
    CHECK((carried() - share * parameters.air.wind).norm() < 1e-10);
    parameters.air.linear_drag = 0.0;
    parameters.air.drag = 0.03;
    const double speed = parameters.air.wind.norm();
    CHECK((carried() - parameters.air.wind * (1.0 - 1.0 / (1.0 + 0.03 * speed * 0.5))).norm() < 1e-10);
  }

  SECTION("a steady wind is a moving frame") {
    parameters.air.drag = 0.03;
    parameters.air.magnus = 0.002;
    const Vec3 velocity(0.4, 2.0, 1.0);
    const Vec3 wind(1.0, -2.0, 0.0);
    const Moment still = simulate(StrandsPlant(parameters, kHands), thrown(velocity, 100.0), {0.5}).front();
    parameters.air.wind = wind;
    const Moment windy =
        simulate(StrandsPlant(parameters, kHands), thrown(velocity + wind, 100.0), {0.5}).front();
    CHECK((windy.state.col(kPosition) - still.state.col(kPosition) - 0.5 * wind).norm() < 1e-10);
  }

  SECTION("Magnus force turns the velocity about the axis") {
    parameters.air.magnus = 0.002;
    const StrandsPlant plant(parameters, kHands);
    const Moment last = simulate(plant, thrown({0.0, 3.0, 0.0}, 150.0), {0.9}).front();
    const double angle = -0.002 * 150.0 * 0.9;
    CHECK(last.state(1, kVelocity) == Approx(3.0 * std::cos(angle)).epsilon(1e-9));
    CHECK(last.state(2, kVelocity) == Approx(3.0 * std::sin(angle)).epsilon(1e-9));
  }

  SECTION("windage") {
    parameters.air.windage = 5e-8;
    const StrandsPlant plant(parameters, kHands);
    const Moment last = simulate(plant, thrown({0.0, 0.0, 1.0}, 150.0), {0.9}).front();
    const double rate = 5e-8 * 150.0 / parameters.diabolo.axial_inertia;
    CHECK(play_spin(parameters.diabolo, last.state) == Approx(150.0 / (1.0 + 0.9 * rate)).epsilon(1e-10));
  }

  SECTION("a drag of the axle slows spin of either sense at a constant rate, down to rest") {
    parameters.diabolo.axle_drag = 20.0;
    const StrandsPlant plant(parameters, kHands);
    for (const double spin : {150.0, -150.0}) {
      const Moment last = simulate(plant, thrown({0.0, 0.0, 1.0}, spin), {0.9}).front();
      CHECK(play_spin(parameters.diabolo, last.state) ==
            Approx(spin - std::copysign(18.0, spin)).epsilon(1e-9));
    }
    const Moment slow = simulate(plant, thrown({0.0, 0.0, 1.0}, 10.0), {0.9}).front();
    CHECK(std::abs(play_spin(parameters.diabolo, slow.state)) < 1e-3);
  }
}
