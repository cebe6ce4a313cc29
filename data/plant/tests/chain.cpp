// SPDX-License-Identifier: MIT
#include "chain.hpp"

#include <algorithm>
#include <cmath>

#include "coulomb.hpp"
#include "support.hpp"

using namespace plant;

namespace {

const Motion kChainHands = still_hands({0.0, 0.35, 1.25}, {0.0, -0.35, 1.25});

/// Free swinging of a taut string between still hands, 2 s.
std::vector<Moment> swinging(PlantParameters parameters, int steps_per_second) {
  parameters.steps_per_second = steps_per_second;
  const ChainPlant plant(parameters, kChainHands);
  Start start;
  start.spin = 0.0;
  start.position = plant.begin(start).state.col(kPosition);
  start.velocity = Vec3(0.0, 0.5, 0.0);
  return simulate(plant, start, times_until(2.0, 100));
}

double distance(const std::vector<Moment>& one, const std::vector<Moment>& other) {
  REQUIRE(one.size() == other.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const Vec3 between = one[i].state.col(kPosition) - other[i].state.col(kPosition);
    largest = std::max(largest, between.norm());
  }
  return largest;
}

}  // namespace

TEST_CASE("a diabolo on a chain hangs at rest by its weight") {
  PlantParameters parameters = chain(lossless());
  parameters.string.stiffness = GENERATE(500.0, 2000.0, 2e5);
  const ChainPlant plant(parameters, kChainHands);
  Start start;
  start.spin = 0.0;
  const Moment moment = simulate(plant, start, {0.5}).front();
  const Reading reading = plant.read(moment);
  CHECK(moment.state.col(kVelocity).norm() < 1e-6);
  CHECK(reading.tensions.left == Approx(reading.tensions.right).epsilon(1e-6));
  // The arc spans the angle between the strands, so that its ends pull up by half the weight each.
  const double expected = parameters.diabolo.mass * 9.80665 / (2.0 * std::sin(0.5 * reading.wrap));
  CHECK(reading.tensions.left == Approx(expected).epsilon(1e-6));
  // The tips carry the string, too: a few grams.
  const Vec3 carried = reading.on_tips[0] + reading.on_tips[1];
  const double most = parameters.diabolo.mass + parameters.string.linear_density * parameters.string.length;
  CHECK(-carried.z() >= parameters.diabolo.mass * 9.80665 * (1.0 - 1e-6));
  CHECK(-carried.z() <= most * 9.80665);
  // The strands sag by their own weight, which shortens the way from tip to tip by some micrometres.
  const double stretch = expected * parameters.string.length / parameters.string.stiffness;
  CHECK(reading.stretch == Approx(stretch).epsilon(0.01).margin(1e-5));
}

TEST_CASE("a chain loses nothing where nothing rubs, damps or drags") {
  PlantParameters parameters = chain(lossless());
  const auto drift = [&](const std::vector<Moment>& moments) {
    const ChainPlant plant(parameters, kChainHands);
    const double first = plant.read(moments.front()).energy;
    double largest = 0.0;
    for (const Moment& moment : moments) {
      REQUIRE(moment.mode == Mode::kOnString);
      largest = std::max(largest, std::abs(plant.read(moment).energy - first));
    }
    return largest;
  };

  SECTION("swinging, but for the weight of the nodes that leap around the axle") {
    const std::vector<Moment> moments = swinging(parameters, 48000);
    CHECK(moments.front().chain.bight != moments[50].chain.bight);
    const double found = drift(moments);
    INFO("drift " << found << " J");
    CHECK(found < 5e-6);
  }

  SECTION("ringing up and down, and with the step's square where it is coarse") {
    const auto ringing = [&](int steps_per_second) {
      parameters.steps_per_second = steps_per_second;
      const ChainPlant plant(parameters, kChainHands);
      Start start;
      start.spin = 0.0;
      start.position = Vec3(plant.begin(start).state.col(kPosition)) - Vec3(0.0, 0.0, 3e-4);
      return drift(simulate(plant, start, times_until(0.3, 300)));
    };
    const double coarse = ringing(24000);
    const double fine = ringing(96000);
    INFO("at 24000 and 96000 steps per second: " << coarse << " and " << fine << " J");
    CHECK(coarse < 1e-5);
    CHECK(fine < 0.3 * coarse);
  }
}

TEST_CASE("the error of a chain falls with the step") {
  const PlantParameters parameters = chain(airless());
  const std::vector<Moment> finest = swinging(parameters, 384000);
  const double coarse = distance(swinging(parameters, 24000), finest);
  const double nominal = distance(swinging(parameters, 48000), finest);
  const double fine = distance(swinging(parameters, 96000), finest);
  INFO("at 24000, 48000 and 96000 steps per second: " << coarse << ", " << nominal << ", " << fine << " m");
  CHECK(nominal < 1e-4);
  CHECK(fine < 0.7 * coarse);
}

TEST_CASE("a diabolo off the chain flies a parabola and keeps its spin") {
  const ChainPlant plant(chain(airless()), kChainHands);
  Start start;
  start.flying = true;
  start.spin = 150.0;
  start.pitch = 0.1;
  start.position = Vec3(0.0, 0.0, 3.0);
  start.velocity = Vec3(0.3, -0.2, 4.0);
  const Moment first = plant.begin(start);
  const Moment last = simulate(plant, start, {0.8}).front();
  REQUIRE(last.mode == Mode::kFlying);
  const Vec3 expected = *start.position + 0.8 * start.velocity + 0.32 * plant.parameters().gravity;
  CHECK((Vec3(last.state.col(kPosition)) - expected).norm() < 1e-9);
  CHECK((last.state.col(kAngularMomentum) - first.state.col(kAngularMomentum)).norm() < 1e-15);
  // A third of a turn later the markers are where a rotation about the axis puts them.
  const Eigen::AngleAxisd turn(orientation(simulate(plant, start, {0.01}).front().state) *
                               orientation(first.state).transpose());
  CHECK(turn.angle() == Approx(1.5).epsilon(1e-6));
  CHECK(turn.axis().dot(first.state.col(kAxis)) == Approx(-1.0).epsilon(1e-6));
}

TEST_CASE("all momentum of string, axle and tips that nothing holds is kept") {
  PlantParameters parameters = chain(lossless());
  parameters.gravity.setZero();
  parameters.string.friction = 0.3;
  parameters.sticks.bending_stiffness = 1e-9;
  parameters.sticks.damping_ratio = 0.0;
  const ChainPlant plant(parameters, kChainHands);
  Start start;
  start.position = Vec3(0.0, 0.05, 0.63);
  start.velocity = Vec3(0.0, 0.4, -1.0);
  const auto momentum = [&](const Moment& moment) {
    Vec3 sum = parameters.diabolo.mass * moment.state.col(kVelocity);
    const std::vector<Vec3>& velocities = moment.chain.velocities;
    const double mass =
        parameters.string.linear_density * parameters.string.length / parameters.string.segments;
    for (std::size_t i = 1; i + 1 < velocities.size(); ++i) sum += mass * velocities[i];
    return Vec3(sum + parameters.sticks.tip_mass * (velocities.front() + velocities.back()));
  };
  const std::vector<Moment> moments = simulate(plant, start, {0.0, 0.1});
  CHECK(moments[1].chain.velocities.front().norm() > 0.1);
  CHECK(moments[1].chain.bight != moments[0].chain.bight);
  const Vec3 change = momentum(moments[1]) - momentum(moments[0]);
  CHECK(change.norm() < 1e-10);  // the sticks' weak springs give some 1e-11 kg m/s
}

TEST_CASE("the two tensions differ by Coulomb's coefficient times the normal force, with the slip's sense") {
  PlantParameters parameters = chain(airless());
  parameters.string.friction = 0.25;

  SECTION("an axle that spins under a string at rest") {
    for (const double spin : {150.0, -150.0}) {
      const ChainPlant plant(parameters, kChainHands);
      Start start;
      start.spin = spin;
      const Moment moment = simulate(plant, start, {0.3}).front();
      const Reading reading = plant.read(moment);
      const double force = (reading.tensions.left + reading.tensions.right) * std::sin(0.5 * reading.wrap);
      CHECK(std::abs(reading.tensions.left - reading.tensions.right) == Approx(0.25 * force).epsilon(1e-6));
      // Positive spin drives the underside towards the right tip, against the pull of the left strand.
      CHECK((reading.tensions.left - reading.tensions.right) * spin > 0.0);
      CHECK(reading.slip * spin < 0.0);
      CHECK(moment.state(1, kPosition) * spin > 0.0);
      CHECK(std::abs(play_spin(parameters.diabolo, moment.state)) < 150.0);
      const double ratio = std::max(reading.tensions.left / reading.tensions.right,
                                    reading.tensions.right / reading.tensions.left);
      CHECK(ratio == Approx(std::exp(equivalent_capstan(0.25, reading.wrap) * reading.wrap)).epsilon(1e-6));
    }
  }

  SECTION("a string that slides over an axle too heavy to turn") {
    parameters.diabolo.axial_inertia = 0.1;
    MotionBuilder hands(SticksPose{});
    hands.oscillate({Vec3(0.0, 0.0, 0.1), Vec3(0.0, 0.0, -0.1)}, 1.5, 3.0);
    const ChainPlant plant(parameters, hands.finish({}, 0));
    Start start;
    start.spin = 0.0;
    int sliding = 0;
    for (const Moment& moment : simulate(plant, start, times_until(2.0, 100))) {
      const Reading reading = plant.read(moment);
      if (std::abs(reading.slip) < 0.1) continue;
      ++sliding;
      const double force = (reading.tensions.left + reading.tensions.right) * std::sin(0.5 * reading.wrap);
      const double difference = reading.tensions.right - reading.tensions.left;
      CHECK(difference == Approx(std::copysign(0.25 * force, reading.slip)).epsilon(0.01));
    }
    CHECK(sliding > 30);
  }
}

TEST_CASE("Coulomb's law is the capstan's for a small angle") {
  CHECK(equivalent_capstan(0.3, 1e-3) == Approx(0.3).epsilon(1e-6));
  CHECK(equivalent_capstan(0.3) == Approx(0.228883).epsilon(1e-4));
  CHECK(equivalent_capstan(0.0) == 0.0);
}
