// SPDX-License-Identifier: MIT
#include "diabolo/effects/air.hpp"

#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

Full in_air(double linear, double quadratic, double wind_x = 0.0, double wind_y = 0.0,
            const Numbers& parameters = {}) {
  return full<Air>(
      [&](auto& air) {
        air.linear_drag = linear;
        air.quadratic_drag = quadratic;
        air.wind_x = wind_x;
        air.wind_y = wind_y;
      },
      parameters);
}

}  // namespace

TEST_CASE("air without drag changes no bit, however strong the wind") {
  const unsigned seed = 720;
  CAPTURE(seed);
  Full::Set set;
  set.get<Air>().wind_x = 3.0;
  set.get<Air>().wind_y = -2.0;
  CHECK(differing_steps(set, seed) == 0);
  set.get<Air>().linear_drag = 1e-6;
  CHECK(differing_steps(set, seed) > 1000);
  set.get<Air>().linear_drag = 0.0;
  set.get<Air>().quadratic_drag = 1e-6;
  CHECK(differing_steps(set, seed) > 1000);
}

TEST_CASE("drag points against the velocity through the air, with the stated size") {
  const unsigned seed = 721;
  CAPTURE(seed);
  Random random(seed);
  for (int i = 0; i < 50; ++i) {
    Air<double> air;
    air.linear_drag = random.uniform(0.0, 1.0);
    air.quadratic_drag = random.uniform(0.0, 1.0);
    air.wind_x = random.uniform(-3.0, 3.0);
    air.wind_y = random.uniform(-3.0, 3.0);
    State<double> state;
    state.velocity = random.vector(5.0);
    const Vector through = state.velocity - Vector(air.wind_x, air.wind_y, 0.0);
    const double speed = through.norm();
    const Vector drag = air.acceleration(state, Tips<double>(), 1e-3, Numbers());
    CHECK(drag.norm() == Approx(speed * air.linear_drag + speed * speed * air.quadratic_drag));
    CHECK(drag.dot(through) == Approx(-drag.norm() * speed));
    // A step of seconds leaves the diabolo floating along, and does not turn it back.
    const Vector stopping = air.acceleration(state, Tips<double>(), 1e3, Numbers()) * 1e3;
    CHECK((stopping + through).norm() < 1e-12 * speed);
  }
}

TEST_CASE("free fall with linear drag, in closed form, with the first order of the step") {
  const double rate = 0.8, time = 1.5;
  const Vector v0(2.0, -1.0, 3.0), end_speed(0.0, 0.0, -kStandardGravity / rate);
  const double kept = std::exp(-rate * time);
  const Vector velocity = end_speed + (v0 - end_speed) * kept;
  const Vector way = end_speed * time + (v0 - end_speed) * ((1.0 - kept) / rate);
  const auto error = [&](int count) {
    const State<double> end = fly(in_air(rate, 0.0), flying(v0), time, count);
    return std::max((end.velocity - velocity).norm(), (end.position - Vector(0.0, 0.0, 100.0) - way).norm());
  };
  // Half a step of the acceleration's rate: rate^2 |v| dt / 2, for 1.5 s.
  CHECK(error(1500) < 0.5 * rate * rate * 20.0 * 1e-3 * time);
  CHECK(error(1500) / error(3000) == Approx(2.0).epsilon(0.01));
}

TEST_CASE("free fall with quadratic drag goes through tanh to its terminal speed") {
  const double coefficient = 0.03, terminal = std::sqrt(kStandardGravity / coefficient);
  const Full model = in_air(0.0, coefficient);
  const auto speed = [&](double time, int count) {
    return -fly(model, flying(Vector::Zero()), time, count).velocity.z();
  };
  const double exact = terminal * std::tanh(kStandardGravity * 1.0 / terminal);
  const double coarse = std::abs(speed(1.0, 1000) - exact), fine = std::abs(speed(1.0, 2000) - exact);
  CHECK(coarse < 2e-3);  // first order: the acceleration's change over the second times dt / 2
  CHECK(coarse / fine == Approx(2.0).epsilon(0.01));
  // Where nothing changes any more the step makes no error.
  CHECK(speed(60.0, 60000) == Approx(terminal).epsilon(1e-9));
}

TEST_CASE("wind carries along what floats") {
  for (const double quadratic : {0.0, 0.5}) {
    const Full model = in_air(1.0, quadratic, 2.0, -3.0, weightless());
    const State<double> end = fly(model, flying(Vector(0.0, 0.0, 1.0)), 30.0, 30000);
    CHECK((end.velocity - Vector(2.0, -3.0, 0.0)).norm() < 1e-9);
  }
  // A flight is the same through still air as with the wind.
  const Vector wind(2.0, -3.0, 0.0), v0(1.0, 0.5, 2.0);
  const State<double> still = fly(in_air(0.3, 0.1), flying(v0), 0.8, 800);
  const State<double> carried =
      fly(in_air(0.3, 0.1, wind.x(), wind.y()), flying(Vector(v0 + wind)), 0.8, 800);
  CHECK((carried.velocity - still.velocity - wind).norm() < 1e-11);
  CHECK((carried.position - still.position - wind * 0.8).norm() < 1e-11);
}

TEST_CASE("a diabolo that hangs in the wind leans by the drag over gravity") {
  for (const double linear : {0.0, 0.2}) {
    Numbers parameters;
    parameters.dissipation_rate = 3.0;
    const Full model = in_air(linear, 0.1, 3.0, 0.0, parameters);
    Tips<double> tips;
    tips.left = tips.right = Vector(0.0, 0.0, 1.0);
    State<double> state;
    state.position = Vector(0.0, 0.0, 0.275);
    state.string_state = StringState::kOnString;
    state = run(
        model, state, [&](double) { return tips; }, 15.0, 15000);
    const double drag = 3.0 * linear + 9.0 * 0.1;
    CHECK(state.position.x() / (1.0 - state.position.z()) == Approx(drag / kStandardGravity).epsilon(1e-6));
  }
}

TEST_CASE("still air takes energy from every swing") {
  const unsigned seed = 722;
  CAPTURE(seed);
  Random random(seed);
  const Full model = in_air(0.2, 0.05);
  double gain = 0.0;
  for (int episode = 0; episode < 20; ++episode) {
    Scene scene = hanging_scene(random);
    const Tips<double> tips = [&] {
      Tips<double> resting = scene.tips.at(0.0);
      resting.left_velocity = resting.right_velocity = Vector::Zero();
      return resting;
    }();
    State<double> state = scene.start;
    const auto energy = [&] {
      return 0.5 * state.velocity.squaredNorm() + kStandardGravity * state.position.z();
    };
    const double start = energy();
    for (int k = 0; k < 500; ++k) {
      const double before = energy();
      model.step(state, tips, tips, 1e-3);
      gain = std::max(gain, energy() - before);
    }
    CHECK(start - energy() > 1e-5);
  }
  CHECK(gain < 1e-6);  // drag of the step's beginning turns late by a step: drag * dt * g * dt at most
}

TEST_CASE("mirrored and turned with its wind, air acts as before") {
  const unsigned seed = 723;
  CAPTURE(seed);
  const Full model = in_air(0.3, 0.2, 2.0, -1.0);
  const auto mirror = [](const auto& x) { return mirrored(x); };
  CHECK(worst_of_symmetry(model, in_air(0.3, 0.2, 2.0, 1.0), mirror, mirror, seed) < 1e-9);
  CHECK(worst_of_symmetry(model, model, mirror, mirror, seed) > 1e-3);
  const Eigen::Matrix3d turn = about_vertical(0.7);
  const Vector wind = turn * Vector(2.0, -1.0, 0.0);
  const auto rotate = [&](const auto& x) { return turned(x, turn); };
  CHECK(worst_of_symmetry(model, in_air(0.3, 0.2, wind.x(), wind.y()), rotate, rotate, seed) < 1e-9);
}

TEST_CASE("on the string air is of the first order of the step") {
  const unsigned seed = 724;
  CAPTURE(seed);
  Random random(seed);
  for (int episode = 0; episode < 5; ++episode) {
    const Scene scene = hanging_scene(random);
    CAPTURE(episode);
    CHECK(halving_ratio(in_air(0.5, 0.3), scene, 1000, apart) == Approx(2.0).epsilon(0.1));
  }
}
