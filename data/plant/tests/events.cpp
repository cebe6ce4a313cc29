// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "support.hpp"

using namespace plant;

namespace {

const Motion kWideHands = still_hands({0.0, 0.4, 1.25}, {0.0, -0.4, 1.25});

Start dropped(const Vec3& position, double yaw = 0.0) {
  Start start;
  start.flying = true;
  start.position = position;
  start.yaw = yaw;
  return start;
}

}  // namespace

TEST_CASE("a string tautens, slackens and parts at its length and at the line of the tips") {
  const StrandsPlant plant(airless(), kWideHands);
  const Start start = dropped({0.0, 0.0, 1.65});
  Moment before = plant.begin(start);
  int catches = 0;
  int tautenings = 0;
  for (int i = 0; i < 48000; ++i) {
    const Moment now = plant.advanced(before, 1.0 / 48000.0);
    REQUIRE_FALSE(now.missed);
    if (before.mode == Mode::kFlying && now.mode == Mode::kLoose) {
      ++catches;
      // Fallen from rest through 0.4 m.
      CHECK(now.time == Approx(std::sqrt(2.0 * 0.4 / 9.80665)).margin(1.0 / 48000.0));
      CHECK(plant.read(now).wrap > 0.0);
      CHECK(plant.read(now).wrap < 0.1);
    }
    if (before.mode == Mode::kLoose && now.mode == Mode::kOnString && ++tautenings == 1) {
      CHECK(plant.read(before).stretch < 0.0);
      CHECK(plant.read(now).stretch > 0.0);
      CHECK(plant.read(now).stretch < 4.0 / 48000.0 * 2.0);
    }
    before = now;
  }
  CHECK(catches == 1);
  CHECK(tautenings >= 1);
}

TEST_CASE("an event is located inside the step, so that its length hardly matters") {
  const auto lands = [](int steps_per_second) {
    PlantParameters parameters = airless();
    parameters.steps_per_second = steps_per_second;
    return simulate(StrandsPlant(parameters, kWideHands), dropped({0.0, 0.05, 1.65}), {0.7}).front();
  };
  const Moment fine = lands(96000);
  const Moment coarse = lands(6000);
  const double distance = (fine.state.col(kPosition) - coarse.state.col(kPosition)).norm();
  CAPTURE(distance);
  CHECK(distance < 1e-6);
}

TEST_CASE("a stiff damped string catches without rebound, at the impulse of an inelastic string") {
  PlantParameters parameters = airless();
  parameters.string.friction = 0.0;
  parameters.string.stiffness = 2e5;
  parameters.string.damping = 2000.0;
  parameters.string.radius = 0.0;
  parameters.diabolo.groove.radius = 1e-6;
  parameters.gravity.setZero();
  const StrandsPlant plant(parameters, kWideHands);
  Start start;
  start.spin = 0.0;
  const double sag = std::sqrt(0.725 * 0.725 - 0.4 * 0.4);
  start.position = Vec3(0.0, 0.0, 1.25 - sag + 0.01);
  start.velocity = Vec3(0.0, 1.0, -2.0);
  REQUIRE(plant.begin(start).mode == Mode::kLoose);
  const std::vector<Moment> moments = simulate(plant, start, {0.0, 0.02});
  // What remains is the velocity along the ellipse; the part along the bisector is gone.
  const Moment last = moments.back();
  const Reading reading = plant.read(last);
  const Vec3 centre = last.state.col(kPosition);
  const Vec3 bisector =
      ((reading.tips[0] - centre).normalized() + (reading.tips[1] - centre).normalized()).normalized();
  CHECK(std::abs(bisector.dot(Vec3(last.state.col(kVelocity)))) < 0.03);
  CHECK(last.state.col(kVelocity).norm() == Approx(1.0).epsilon(0.03));
}

TEST_CASE("the string misses a diabolo beside it, across it or beyond the tips") {
  const StrandsPlant plant(airless(), kWideHands);
  const auto last_of = [&](const Start& start) { return simulate(plant, start, times_until(0.6, 60)); };
  CHECK(last_of(dropped({0.0, 0.0, 1.5})).size() == 61);
  CHECK(last_of(dropped({0.05, 0.0, 1.5})).size() == 61);
  CHECK(last_of(dropped({0.065, 0.0, 1.5})).size() < 61);
  CHECK(last_of(dropped({0.0, 0.45, 1.5})).size() < 61);
  CHECK(last_of(dropped({0.0, 0.0, 1.5}, 0.5)).size() == 61);
  CHECK(last_of(dropped({0.0, 0.0, 1.5}, 1.0)).size() < 61);
}

TEST_CASE("a slack wrapped string does not let go") {
  PlantParameters parameters = airless();
  parameters.string.wraps = GENERATE(0, 1);
  const StrandsPlant plant(parameters, kWideHands);
  Start start;
  start.spin = 0.0;
  start.position = Vec3(0.0, 0.0, 1.1);
  start.velocity = Vec3(0.0, 0.0, 2.2);
  const std::vector<Moment> moments = simulate(plant, start, times_until(0.2, 50));
  const bool flies =
      std::any_of(moments.begin(), moments.end(), [](const Moment& m) { return m.mode == Mode::kFlying; });
  CHECK(flies == (parameters.string.wraps == 0));
}
