// SPDX-License-Identifier: MIT
// A slack string that comes taut within a step: when, where, and what is left of the velocity.

#include <algorithm>

#include "catch.hpp"
#include "diabolo/predictor.hpp"
#include "smooth_tips.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

constexpr double kHopDuration = 0.5, kLength = 1.45;

/// A hop: slack at first, taut from `snap_time` on.
struct Hop {
  SmoothTips tips;
  Vector position, velocity;
  double snap_time = 0.0;
  TautReference end;
};

double path_length(const Hop& hop, double time) {
  const Vector p =
      hop.position + hop.velocity * time - Vector(0.0, 0.0, 0.5 * kStandardGravity * time * time);
  return (p - hop.tips.left.position(time)).norm() + (p - hop.tips.right.position(time)).norm();
}

/// Draws hops until one snaps once, in the middle, at a good speed, below the tips, and stays taut.
Hop random_hop(Random& random) {
  for (;;) {
    Hop hop;
    hop.tips = SmoothTips::random(random, random.uniform(0.1, 0.8), 0.1, 8.0);
    const Tips<double> begin = hop.tips.at(0.0);
    const Spheroid<double> spheroid(begin.left, begin.right, kLength);
    hop.position = spheroid.closest_point(spheroid.center() - Vector(0.0, 0.0, 1.0)) + Vector(0.0, 0.0, 0.1);
    hop.velocity = random.vector(0.5) + Vector(0.0, 0.0, 0.5);
    if (path_length(hop, 0.0) > kLength - 0.02) continue;
    double low = 0.0, high = 0.0;
    while (high < kHopDuration && path_length(hop, high) < kLength) low = high, high += 1e-3;
    if (high >= kHopDuration - 0.1) continue;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (path_length(hop, middle) < kLength ? low : high) = middle;
    }
    hop.snap_time = high;
    TautReference reference;
    reference.tips = hop.tips;
    reference.time = high;
    reference.position =
        hop.position + hop.velocity * high - Vector(0.0, 0.0, 0.5 * kStandardGravity * high * high);
    reference.velocity = hop.velocity - Vector(0.0, 0.0, kStandardGravity * high);
    reference.make_consistent();  // an inelastic catch is this projection
    if (reference.advance(kHopDuration, 1e-4) < 1.0) continue;
    hop.end = reference;
    return hop;
  }
}

struct Outcome {
  double position_error = 0.0, velocity_error = 0.0;
  int snaps = 0;
  double snap_end = 0.0;  ///< end of the first step that snapped [s]
};

Outcome run(const Hop& hop, int steps) {
  const Predictor<double> predictor(Parameters<double>::consistent());
  State<double> state;
  state.position = hop.position;
  state.velocity = hop.velocity;
  Outcome outcome;
  const double dt = kHopDuration / steps;
  for (int i = 0; i < steps; ++i) {
    const StepStatus<double> status =
        predictor.step(state, hop.tips.at(i * dt), hop.tips.at((i + 1) * dt), dt);
    if (status.snapped_taut) {
      if (outcome.snaps++ == 0) outcome.snap_end = (i + 1) * dt;
    }
  }
  outcome.position_error = (state.position - hop.end.position).norm();
  outcome.velocity_error = (state.velocity - hop.end.velocity).norm();
  return outcome;
}

}  // namespace

TEST_CASE("the string snaps taut once, in the right step") {
  Random random(300);
  for (int i = 0; i < 30; ++i) {
    const Hop hop = random_hop(random);
    for (const int steps : {100, 500, 1000}) {
      const double dt = kHopDuration / steps;
      const Outcome outcome = run(hop, steps);
      // Caught at the very end of a step, the string may be some nm slack after it and snap in the next one
      // too.
      CHECK(outcome.snaps >= 1);
      CHECK(outcome.snaps <= 2);
      // Tips move on straight lines within a step: dt^2 * acceleration / 8 away, at some m/s.
      CHECK(outcome.snap_end >= hop.snap_time - dt * dt * 10.0);
      CHECK(outcome.snap_end <= hop.snap_time + dt + dt * dt * 10.0);
    }
  }
}

TEST_CASE("across a snap the motion still converges with the second order of the step") {
  Random random(301);
  for (int i = 0; i < 20; ++i) {
    const Hop hop = random_hop(random);
    // Where the snap lies within its step changes the error's factor: compare over a wide range of steps.
    double coarse_position = 0.0, coarse_velocity = 0.0, fine_position = 0.0, fine_velocity = 0.0;
    for (int k = 0; k < 5; ++k) {
      const Outcome coarse = run(hop, 100 + 3 * k), fine = run(hop, 800 + 24 * k);
      coarse_position = std::max(coarse_position, coarse.position_error);
      coarse_velocity = std::max(coarse_velocity, coarse.velocity_error);
      fine_position = std::max(fine_position, fine.position_error);
      fine_velocity = std::max(fine_velocity, fine.velocity_error);
    }
    CAPTURE(i, coarse_position, fine_position, coarse_velocity, fine_velocity);
    CHECK(fine_position < 1e-5);
    // Eight times finer: 1/64 of the error, 1/8 for a first order.
    CHECK(fine_position < coarse_position / 30.0);
    CHECK(fine_velocity < coarse_velocity / 30.0);
  }
}

TEST_CASE("a catch is inelastic along the string and free across it") {
  // Straight down onto a string between narrow tips: the fall ends. With a sideways velocity that one stays.
  const Predictor<double> predictor(Parameters<double>::consistent());
  Tips<double> tips;
  tips.left = Vector(0.0, 0.2, 1.0);
  tips.right = Vector(0.0, -0.2, 1.0);
  const Spheroid<double> spheroid(tips.left, tips.right, kLength);
  for (const double sideways : {0.0, 0.7}) {
    State<double> state;
    state.position = spheroid.center() - Vector(0.0, 0.0, spheroid.semi_minor() - 1e-4);
    state.velocity = Vector(sideways, 0.0, -3.0);
    StepStatus<double> status;
    for (int i = 0; i < 3 && !status.snapped_taut; ++i) status = predictor.step(state, tips, tips, 1e-4);
    REQUIRE(status.snapped_taut);
    CHECK(std::abs(state.velocity.z()) < 1e-3 + sideways * 1e-3);
    CHECK(state.velocity.x() == Approx(sideways).margin(1e-3));
    CHECK(state.string_state == StringState::kOnString);
  }
}

TEST_CASE("a pull through a slack string throws the diabolo only from where it is taut") {
  // The tips rise at 2 m/s under a string with 0.1 m of slack: until taut the diabolo falls, then it goes
  // along.
  const Predictor<double> predictor(Parameters<double>::consistent());
  const double dt = 1e-3, speed = 2.0, slack = 0.1;
  const auto tips_at = [&](double t) {
    Tips<double> tips;
    tips.left = tips.right = Vector(0.0, 0.0, 1.0 + speed * t);
    tips.left_velocity = tips.right_velocity = Vector(0.0, 0.0, speed);
    return tips;
  };
  State<double> state;
  state.position = Vector(0.0, 0.0, 1.0 - 0.5 * kLength + slack);
  double snapped = -1.0;
  for (int i = 0; i < 100; ++i)
    if (predictor.step(state, tips_at(i * dt), tips_at((i + 1) * dt), dt).snapped_taut)
      snapped = (i + 1) * dt;
  // slack = speed t + g t^2 / 2
  const double expected =
      (std::sqrt(speed * speed + 2.0 * kStandardGravity * slack) - speed) / kStandardGravity;
  CHECK(snapped >= expected);
  CHECK(snapped < expected + dt);
  CHECK((state.velocity - Vector(0.0, 0.0, speed)).norm() < 1e-9);
  CHECK(state.string_acceleration.z() == Approx(kStandardGravity).epsilon(1e-6));
}
