// SPDX-License-Identifier: MIT
#include "diabolo/effects/magnus_lift.hpp"

#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

Full lifting(double coefficient, const Numbers& parameters = {}) {
  return full<MagnusLift>([&](auto& lift) { lift.coefficient = coefficient; }, parameters);
}

}  // namespace

TEST_CASE("lift of coefficient zero changes no bit") {
  const unsigned seed = 730;
  CAPTURE(seed);
  Full::Set set;
  CHECK(differing_steps(set, seed) == 0);
  set.get<MagnusLift>().coefficient = 1e-8;
  CHECK(differing_steps(set, seed) > 1000);
}

TEST_CASE("back spin lifts, top spin presses down") {
  // Positive spin: the lower side moves to the right (-y), which is back spin in a flight to the right.
  const auto height = [](double coefficient, double spin, double direction) {
    return fly(lifting(coefficient), flying(Vector(0.0, 4.0 * direction, 0.0), spin), 0.5, 500).position.z();
  };
  const double plain = height(0.0, 100.0, -1.0);
  CHECK(height(1e-3, 100.0, -1.0) > plain + 0.01);
  CHECK(height(1e-3, -100.0, 1.0) > plain + 0.01);
  CHECK(height(1e-3, 100.0, 1.0) < plain - 0.01);
  CHECK(height(1e-3, -100.0, -1.0) < plain - 0.01);
  CHECK(height(-1e-3, 100.0, -1.0) < plain - 0.01);
}

TEST_CASE("lift is across velocity and axle, in proportion to spin and speed, and does no work") {
  const unsigned seed = 731;
  CAPTURE(seed);
  Random random(seed);
  for (int i = 0; i < 50; ++i) {
    MagnusLift<double> lift;
    lift.coefficient = random.uniform(1e-4, 2e-3);
    State<double> state;
    state.velocity = random.vector(5.0);
    state.axis = random.direction();
    state.spin = random.uniform(-200.0, 200.0);
    const Vector a = lift.acceleration(state, Tips<double>(), 1e-9, Numbers());
    const double sine = std::sqrt(1.0 - std::pow(state.axis.dot(state.velocity.normalized()), 2));
    CHECK(a.norm() == Approx(lift.coefficient * std::abs(state.spin) * state.velocity.norm() * sine));
    CHECK(std::abs(a.dot(state.axis)) < 1e-14);
    // However long the step, of whatever turn.
    for (const double dt : {1e-3, 1.0, 1e3}) {
      const Vector after = state.velocity + lift.acceleration(state, Tips<double>(), dt, Numbers()) * dt;
      CHECK(after.norm() == Approx(state.velocity.norm()).epsilon(1e-12));
    }
  }
}

TEST_CASE("without gravity the velocity turns about the axle at coefficient times spin") {
  const unsigned seed = 732;
  CAPTURE(seed);
  Random random(seed);
  const double coefficient = 5e-3, spin = 100.0, rate = coefficient * spin, time = 2.0;
  for (int i = 0; i < 5; ++i) {
    State<double> start = flying(Vector::Zero(), spin);
    start.axis = random.direction();
    start.velocity = start.axis.cross(random.direction()).normalized() * 3.0;
    // The angular velocity is -spin * axis, and so is the turn.
    const Vector exact = Eigen::AngleAxisd(-rate * time, start.axis) * start.velocity;
    const auto end = [&](int count) { return fly(lifting(coefficient, weightless()), start, time, count); };
    const double coarse = (end(2000).velocity - exact).norm(), fine = (end(4000).velocity - exact).norm();
    // Each step's angle is short by the share (rate dt)^2 / 12.
    CHECK(coarse < 1.01 * 3.0 * std::pow(rate, 3) * 1e-6 / 12.0 * time);
    CHECK(coarse / fine == Approx(4.0).epsilon(0.01));
    CHECK(end(2000).velocity.norm() == Approx(3.0).epsilon(1e-12));
    // Around a circle of radius v / rate, back after a whole turn.
    const double turn = 2.0 * M_PI / rate;
    const State<double> back = fly(lifting(coefficient, weightless()), start, turn, 1000);
    CHECK((back.position - start.position).norm() < 1e-4 * 3.0 / rate);
  }
}

TEST_CASE("a flight along the axle and one without spin have no lift") {
  State<double> along = flying(Vector(4.0, 0.0, 0.0), 150.0);
  CHECK(same_bits(fly(lifting(2e-3, weightless()), along, 0.5, 500),
                  fly(lifting(0.0, weightless()), along, 0.5, 500)));
  State<double> still = flying(Vector(1.0, 4.0, 2.0), 0.0);
  CHECK(same_bits(fly(lifting(2e-3), still, 0.5, 500), fly(lifting(0.0), still, 0.5, 500)));
}

TEST_CASE("mirrored and turned with its axle, lift acts as before") {
  const unsigned seed = 733;
  CAPTURE(seed);
  const Full model = lifting(2e-3);
  const auto mirror = [](const auto& x) { return mirrored(x); };
  CHECK(worst_of_symmetry(model, model, mirror, mirror, seed) < 1e-9);
  CHECK(worst_of_symmetry(model, lifting(-2e-3), mirror, mirror, seed) > 1e-3);
  const Eigen::Matrix3d turn = about_vertical(0.7);
  const auto rotate = [&](const auto& x) { return turned(x, turn); };
  CHECK(worst_of_symmetry(model, model, rotate, rotate, seed) < 1e-9);
}

TEST_CASE("on the string lift is of the first order of the step") {
  const unsigned seed = 734;
  CAPTURE(seed);
  Random random(seed);
  for (int episode = 0; episode < 5; ++episode) {
    const Scene scene = hanging_scene(random);
    CAPTURE(episode);
    CHECK(halving_ratio(lifting(1e-2), scene, 1000, apart) == Approx(2.0).epsilon(0.1));
  }
}
