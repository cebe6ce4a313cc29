// SPDX-License-Identifier: MIT
// The taut string against an independent solution of its equations of motion.

#include <vector>

#include "catch.hpp"
#include "diabolo/predictor.hpp"
#include "smooth_tips.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

constexpr double kSwingDuration = 1.0;

/// Tips and a start from which the string stays taut for kSwingDuration, by the reference.
struct Swing {
  SmoothTips tips;
  TautReference start, end;
};

Swing random_swing(Random& random, double distance, double amplitude) {
  for (;;) {
    Swing swing;
    swing.tips = SmoothTips::random(random, distance, amplitude, 8.0);
    const Tips<double> begin = swing.tips.at(0.0);
    const Spheroid<double> spheroid(begin.left, begin.right, 1.45);
    swing.start.tips = swing.tips;
    swing.start.position =
        spheroid.closest_point(spheroid.center() + random.vector(0.3) + Vector(0.0, 0.0, -1.0));
    swing.start.velocity = random.vector(1.5);
    swing.start.make_consistent();
    swing.end = swing.start;
    if (swing.end.advance(kSwingDuration, 1e-3) < 1.0) continue;  // the string nearly slack somewhere
    swing.end = swing.start;
    swing.end.advance(kSwingDuration, 1e-4);
    return swing;
  }
}

struct Errors {
  double position, velocity, tension;
};

/// Largest errors over the motion with the given number of steps.
Errors errors_of(const Swing& swing, int steps) {
  const Predictor<double> predictor(Parameters<double>::consistent());
  const double dt = kSwingDuration / steps;
  State<double> state;
  state.position = swing.start.position;
  state.velocity = swing.start.velocity;
  TautReference reference = swing.start;
  Errors worst{0.0, 0.0, 0.0};
  const int per_step = std::max(1, 1000 / steps);
  for (int i = 0; i < steps; ++i) {
    const Tips<double> now = swing.tips.at(i * dt), next = swing.tips.at((i + 1) * dt);
    predictor.step(state, now, next, dt);
    REQUIRE(state.string_state == StringState::kOnString);
    reference.advance((i + 0.5) * dt, 0.5 * dt / per_step);
    const double tension = reference.tension();
    const Vector strands = (reference.position - swing.tips.left.position(reference.time)).normalized() +
                           (reference.position - swing.tips.right.position(reference.time)).normalized();
    reference.advance((i + 1) * dt, 0.5 * dt / per_step);
    worst.position = std::max(worst.position, (state.position - reference.position).norm());
    worst.velocity = std::max(worst.velocity, (state.velocity - reference.velocity).norm());
    // Where the start does not fit the constraint of a finite step, the tension swings in within some steps.
    if (2 * i > steps)
      worst.tension =
          std::max(worst.tension, std::abs(state.string_acceleration.norm() / strands.norm() - tension));
  }
  return worst;
}

}  // namespace

TEST_CASE("the reference keeps the string's length and converges") {
  Random random(100);
  const Swing swing = random_swing(random, 0.4, 0.1);
  const Tips<double> tips = swing.tips.at(kSwingDuration);
  CHECK((swing.end.position - tips.left).norm() + (swing.end.position - tips.right).norm() ==
        Approx(1.45).epsilon(0).margin(1e-10));
  TautReference coarse = swing.start;
  coarse.advance(kSwingDuration, 1e-3);
  CHECK((coarse.position - swing.end.position).norm() < 1e-8);
}

TEST_CASE("position, velocity and tension converge to the reference with the second order of the step") {
  for (const double distance : {0.05, 0.12, 0.5, 1.0})
    for (int seed = 0; seed < 4; ++seed) {
      Random random(110 + static_cast<unsigned>(seed));
      CAPTURE(distance, seed);
      const Swing swing = random_swing(random, distance, 0.15);
      const Errors coarse = errors_of(swing, 250), fine = errors_of(swing, 500),
                   finest = errors_of(swing, 1000);
      CAPTURE(finest.position, finest.velocity, finest.tension);
      CHECK(finest.position < 2e-5);
      CHECK(finest.velocity < 2e-4);
      // Halving the step divides the errors by four; 15 % for the terms of the next order.
      CHECK(coarse.position / fine.position == Approx(4.0).epsilon(0.15));
      CHECK(fine.position / finest.position == Approx(4.0).epsilon(0.15));
      CHECK(coarse.velocity / fine.velocity == Approx(4.0).epsilon(0.15));
      CHECK(fine.velocity / finest.velocity == Approx(4.0).epsilon(0.15));
      // The position is solved to 1e-10 of the string's length; so much noise has the acceleration.
      const auto noise = [](double dt) { return 4.0 * constraint_tolerance<double>() * 1.45 / (dt * dt); };
      CHECK(fine.tension < 0.25 * 1.15 * coarse.tension + noise(2e-3));
      CHECK(finest.tension < 0.25 * 1.15 * fine.tension + noise(1e-3));
    }
}

TEST_CASE("the spin converges with the second order of the step") {
  Parameters<double> parameters = Parameters<double>::consistent();
  parameters.spin_coupling = 20.0;  // so that a swing turns it a lot
  const Predictor<double> predictor(parameters);
  for (int seed = 0; seed < 5; ++seed) {
    Random random(130 + static_cast<unsigned>(seed));
    const Swing swing = random_swing(random, 0.3, 0.15);
    // r dw/dt = k (u - r w), u half the rate of the strands' difference: trapezoidal rule over fine steps.
    const double k = parameters.spin_coupling, r = parameters.axle_radius, h = 1e-4;
    double exact = 50.0;
    TautReference reference = swing.start;
    const auto string_speed = [&] {
      const Vector l = reference.position - swing.tips.left.position(reference.time),
                   right = reference.position - swing.tips.right.position(reference.time);
      return 0.5 * (right.normalized().dot(reference.velocity - swing.tips.right.velocity(reference.time)) -
                    l.normalized().dot(reference.velocity - swing.tips.left.velocity(reference.time)));
    };
    for (int i = 0; i < 10000; ++i) {
      const double before = string_speed();
      reference.advance((i + 1) * h, h);
      const double speed = 0.5 * (before + string_speed());
      exact = ((1.0 - 0.5 * k * h) * exact + k * h * speed / r) / (1.0 + 0.5 * k * h);
    }
    const auto error = [&](int steps) {
      State<double> state;
      state.position = swing.start.position;
      state.velocity = swing.start.velocity;
      state.spin = 50.0;
      for (int i = 0; i < steps; ++i)
        predictor.step(state, swing.tips.at(i * kSwingDuration / steps),
                       swing.tips.at((i + 1) * kSwingDuration / steps), kSwingDuration / steps);
      return std::abs(state.spin - exact);
    };
    const double coarse = error(250), fine = error(500), finest = error(1000);
    CAPTURE(seed, exact, coarse, fine, finest);
    CHECK(fine / finest == Approx(4.0).epsilon(0.2));
    CHECK(coarse / fine > 3.2);
  }
}
