// SPDX-License-Identifier: MIT
// Laws that the project's diagnosis has no name for.
#include <algorithm>
#include <cmath>

#include "chain.hpp"
#include "support.hpp"

using namespace plant;

namespace {

const Vec3 kGust(0.7, -1.1, 0.4);
constexpr double kFrequency = 0.8;  // [Hz]
constexpr double kGustPhase = 0.5;  // [rad]
constexpr double kTurning = 2.0 * std::numbers::pi * kFrequency;

PlantParameters weightless() {
  PlantParameters parameters = airless();
  parameters.gravity.setZero();
  return parameters;
}

State after(const PlantParameters& parameters, const Start& start, double time,
            const Motion& motion = kHands) {
  return simulate(*make_plant(parameters, motion), start, {time}).front().state;
}

}  // namespace

TEST_CASE("a gust shakes a diabolo in flight by its double integral") {
  PlantParameters parameters = weightless();
  parameters.air.gust = kGust;
  parameters.air.gust_frequency = kFrequency;
  parameters.air.gust_phase = kGustPhase;
  const double time = 1.7;
  const double speed = (std::cos(kGustPhase) - std::cos(kTurning * time + kGustPhase)) / kTurning;
  const double distance = (std::cos(kGustPhase) * time -
                           (std::sin(kTurning * time + kGustPhase) - std::sin(kGustPhase)) / kTurning) /
                          kTurning;
  const State strands = after(parameters, thrown(Vec3::Zero(), 100.0), time);
  CHECK((strands.col(kVelocity) - speed * kGust).norm() < 1e-10);
  CHECK((strands.col(kPosition) - Vec3(0.0, 0.0, 3.0) - distance * kGust).norm() < 1e-10);
  const State nodes = after(chain(parameters), thrown(Vec3::Zero(), 100.0), time);
  CHECK((nodes.col(kPosition) - Vec3(0.0, 0.0, 3.0) - distance * kGust).norm() < 1e-6);
}

TEST_CASE("a gust of the spin adds its integral, about the axis") {
  PlantParameters parameters = weightless();
  parameters.air.spin_gust = 9.0;
  parameters.air.gust_frequency = kFrequency;
  parameters.air.gust_phase = kGustPhase;
  const double time = 1.7;
  const double gain = 9.0 * (std::cos(kGustPhase) - std::cos(kTurning * time + kGustPhase)) / kTurning;
  for (const PlantParameters& plant : {parameters, chain(parameters)}) {
    const State state = after(plant, thrown(Vec3::Zero(), 100.0), time);
    CHECK(spin_about_axis(plant.diabolo, state) == Approx(-100.0 + gain).epsilon(1e-8));
  }
}

TEST_CASE("a constant drag slows at one rate, down to rest, and against the wind") {
  PlantParameters parameters = weightless();
  parameters.air.constant_drag = 1.5;
  const State fast = after(parameters, thrown({0.0, 4.0, 0.0}, 0.0), 0.8);
  CHECK(fast(1, kVelocity) == Approx(4.0 - 1.5 * 0.8).epsilon(1e-10));
  CHECK(fast(1, kPosition) == Approx(4.0 * 0.8 - 0.75 * 0.64).epsilon(1e-10));
  const State slow = after(parameters, thrown({0.0, 0.5, 0.0}, 0.0), 1.0);
  CHECK(slow.col(kVelocity).norm() < 1e-6);
  parameters.air.wind = Vec3(0.0, 3.0, 0.0);
  CHECK(after(parameters, thrown(Vec3::Zero(), 0.0), 0.8)(1, kVelocity) == Approx(1.5 * 0.8).epsilon(1e-10));
}

TEST_CASE("a drag of any power is the same at 2 m/s, and follows its closed form") {
  PlantParameters parameters = weightless();
  parameters.air.drag = 0.03;
  for (const double power : {1.0, 1.5, 2.0, 3.0}) {
    CAPTURE(power);
    parameters.air.drag_power = power;
    const Vec3 velocity(0.0, 1.2, 1.6);
    const Vec3 push =
        air_acceleration(parameters.air, {0.0, Vec3::Zero(), velocity, Vec3::UnitX(), 0.0, Vec3::Zero()});
    CHECK((push + 0.06 * velocity).norm() < 1e-15);
  }
  // v' = -c v^3 with c = 0.03 * 2^2 / 2^3
  parameters.air.drag_power = 3.0;
  const State cubic = after(parameters, thrown({0.0, 5.0, 0.0}, 0.0), 0.9);
  CHECK(cubic(1, kVelocity) == Approx(5.0 / std::sqrt(1.0 + 2.0 * 0.015 * 25.0 * 0.9)).epsilon(1e-10));
  parameters.air.drag_power = 1.0;
  const State linear = after(parameters, thrown({0.0, 5.0, 0.0}, 0.0), 0.9);
  CHECK(linear(1, kVelocity) == Approx(5.0 * std::exp(-0.06 * 0.9)).epsilon(1e-10));
}

TEST_CASE("a windage of any power is the same at 100 rad/s, and follows its closed form") {
  PlantParameters parameters = weightless();
  parameters.air.windage = 5e-7;
  for (const double power : {0.5, 1.0, 2.0, 3.0}) {
    CAPTURE(power);
    parameters.air.windage_power = power;
    for (const double spin : {100.0, -100.0}) {
      CHECK(windage_torque(parameters.air, spin) == Approx(std::copysign(5e-3, -spin)).epsilon(1e-14));
    }
  }
  parameters.air.windage_power = 1.0;
  const double rate = 5e-7 * 100.0 / parameters.diabolo.axial_inertia;
  for (const PlantParameters& plant : {parameters, chain(parameters)}) {
    const State state = after(plant, thrown(Vec3::Zero(), 150.0), 0.9);
    CHECK(play_spin(plant.diabolo, state) == Approx(150.0 * std::exp(-rate * 0.9)).epsilon(1e-5));
  }
}

TEST_CASE("a pull towards a place is a spring without a string") {
  PlantParameters parameters = weightless();
  parameters.air.pull = 6.0;
  parameters.air.pull_centre = Vec3(0.2, -0.3, 3.1);
  const Start start = thrown({0.5, 0.0, -0.2}, 0.0);
  const double time = 1.1, angle = std::sqrt(6.0) * time;
  const Vec3 expected = parameters.air.pull_centre +
                        std::cos(angle) * (*start.position - parameters.air.pull_centre) +
                        std::sin(angle) / std::sqrt(6.0) * start.velocity;
  CHECK((after(parameters, start, time).col(kPosition) - expected).norm() < 1e-10);
  CHECK((after(chain(parameters), start, time).col(kPosition) - expected).norm() < 1e-6);
}

TEST_CASE("the tips' wake carries the diabolo as far as the hands go") {
  PlantParameters parameters = weightless();
  parameters.air.tip_wake = 0.8;
  MotionBuilder hands(SticksPose{});
  hands.move(0.5, {Vec3(0.1, 0.0, 0.3), Vec3(0.1, 0.0, 0.1)});
  hands.hold(2.0);
  const Motion motion = hands.finish({}, 0);
  for (const PlantParameters& plant : {parameters, chain(parameters)}) {
    const State state = after(plant, thrown(Vec3::Zero(), 0.0), 0.6, motion);
    CHECK((state.col(kVelocity) - 0.8 * Vec3(0.1, 0.0, 0.2)).norm() < 1e-6);
  }
}

TEST_CASE("a creeping string lets a diabolo at rest down by its growth") {
  PlantParameters parameters = lossless();
  parameters.string.damping = 10.0;
  parameters.string.creep = 0.004;
  const StrandsPlant plant(parameters, still_hands({0.0, 0.05, 1.25}, {0.0, -0.05, 1.25}));
  Start start;
  start.spin = 0.0;
  const std::vector<Moment> moments = simulate(plant, start, {0.0, 2.0, 10.0});
  const auto length = [&](const Moment& moment) {
    const Vec3 position = moment.state.col(kPosition);
    return (Vec3(0.0, 0.05, 1.25) - position).norm() + (Vec3(0.0, -0.05, 1.25) - position).norm();
  };
  CHECK(length(moments[1]) - length(moments[0]) == Approx(0.004 * 2.0).epsilon(0.01));
  CHECK(length(moments[2]) - length(moments[1]) == Approx(0.004 * 8.0).epsilon(0.002));
  // The load stays the weight; it stretches a longer string the more.
  const Reading first = plant.read(moments[1]), last = plant.read(moments[2]);
  CHECK(last.tensions.left == Approx(first.tensions.left).epsilon(1e-3));
  CHECK(last.stretch / first.stretch == Approx(1.49 / 1.458).epsilon(2e-3));
}

TEST_CASE("a drag by the tension slows a swing by its work, and a flight not at all") {
  PlantParameters parameters = lossless();
  parameters.diabolo.tension_drag = 0.3;
  const State flight = after(parameters, thrown({0.0, 1.0, 0.0}, 0.0), 0.3);
  CHECK(flight(1, kVelocity) == 1.0);

  const StrandsPlant plant(parameters, kHands);
  const Start start = on_ellipse(parameters, plant.motion(), 0.004, 0.15, Vec3::Zero());
  const int count = 4000;
  const std::vector<Moment> moments = simulate(plant, start, times_until(1.0, count));
  double work = 0.0;
  for (const Moment& moment : moments) {
    const Tensions tensions = plant.read(moment).tensions;
    const Vec3 velocity = moment.state.col(kVelocity);
    const double force = parameters.diabolo.mass * 0.3 * 0.5 * (tensions.left + tensions.right);
    work += force * heading(velocity).dot(velocity) / count;
  }
  const double lost = plant.read(moments.front()).energy - plant.read(moments.back()).energy;
  CHECK(lost > 0.01);
  CHECK(lost == Approx(work).epsilon(0.01));
}

TEST_CASE("what is nought changes no bit of a play, whatever its frequency, phase and place") {
  PlantParameters parameters;
  parameters.air.gust_frequency = kFrequency;
  parameters.air.gust_phase = kGustPhase;
  parameters.air.pull_centre = Vec3(0.2, -0.3, 1.1);
  MotionBuilder hands(SticksPose{});
  hands.oscillate({Vec3(0.0, 0.05, 0.15), Vec3(0.0, 0.05, 0.14)}, 1.5, 4.0);
  const Motion motion = hands.finish({}, 0);
  CHECK(after(parameters, Start{}, 1.5, motion) == after(PlantParameters{}, Start{}, 1.5, motion));
  PlantParameters none = chain(PlantParameters{});
  parameters.structure = none.structure;
  parameters.string = none.string;
  parameters.sticks.bending_stiffness = none.sticks.bending_stiffness = std::nullopt;
  CHECK(after(parameters, Start{}, 1.0, motion) == after(none, Start{}, 1.0, motion));
}
