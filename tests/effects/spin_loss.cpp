// SPDX-License-Identifier: MIT
#include "diabolo/effects/spin_loss.hpp"

#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

Full losing(double air, double axle, double spin_coupling = 0.0) {
  Numbers parameters;
  parameters.spin_coupling = spin_coupling;
  return full<SpinLoss>(
      [&](auto& loss) {
        loss.air = air;
        loss.axle = axle;
      },
      parameters);
}

double spin_after(const Full& model, double spin, double time, int count) {
  return fly(model, flying(Vector::Zero(), spin), time, count).spin;
}

}  // namespace

TEST_CASE("spin loss of amplitude zero changes no bit") {
  const unsigned seed = 740;
  CAPTURE(seed);
  Full::Set set;
  CHECK(differing_steps(set, seed) == 0);
  set.get<SpinLoss>().air = 1e-8;
  CHECK(differing_steps(set, seed) > 1000);
  set.get<SpinLoss>().air = 0.0;
  set.get<SpinLoss>().axle = 1e-6;
  CHECK(differing_steps(set, seed) > 1000);
}

TEST_CASE("air alone: 1 / spin grows in proportion to time, whatever the step") {
  for (const double start : {150.0, -150.0}) {
    const double air = 2e-3, time = 3.0, exact = start / (1.0 + air * std::abs(start) * time);
    for (const int count : {1, 3, 3000})
      CHECK(spin_after(losing(air, 0.0), start, time, count) == Approx(exact).epsilon(1e-11));
  }
}

TEST_CASE("the axle alone: spin falls on a straight line, stops and stays") {
  for (const double sign : {1.0, -1.0}) {
    const Full model = losing(0.0, 30.0);
    CHECK(spin_after(model, 100.0 * sign, 2.5, 2500) == Approx(25.0 * sign).epsilon(1e-12));
    CHECK(spin_after(model, 100.0 * sign, 5.0, 5000) == 0.0);
    CHECK(spin_after(model, 100.0 * sign, 5.0, 1) == 0.0);
    State<double> state = flying(Vector::Zero(), 3.0 * sign);
    for (int i = 0; i < 200; ++i) {
      const double before = std::abs(state.spin);
      model.step(state, Tips<double>(), Tips<double>(), 1.0 / 120.0);
      CHECK(std::abs(state.spin) <= before);
      CHECK(state.spin * sign >= 0.0);
    }
  }
}

TEST_CASE("air and axle together: an arc tangent of the spin falls on a straight line") {
  // dw/dt = -axle - air w^2 has the solution w = r tan(atan(w0 / r) - air r t), r^2 = axle / air.
  const double air = 2e-3, axle = 30.0, r = std::sqrt(axle / air), time = 1.5;
  const double exact = r * std::tan(std::atan(150.0 / r) - air * r * time);
  const double coarse = spin_after(losing(air, axle), 150.0, time, 750) - exact,
               fine = spin_after(losing(air, axle), 150.0, time, 1500) - exact;
  CHECK(std::abs(coarse) < 1e-3 * exact);
  CHECK(coarse / fine == Approx(2.0).epsilon(0.01));
}

TEST_CASE("spin is lost in every string state, and moves nothing") {
  const unsigned seed = 741;
  CAPTURE(seed);
  Random random(seed);
  for (int episode = 0; episode < 10; ++episode) {
    Scene scene = hanging_scene(random);
    const auto at = [&](double t) { return scene.tips.at(t); };
    scene.start.spin = 80.0;
    for (const StringState string_state :
         {StringState::kOnString, StringState::kLoose, StringState::kFlying}) {
      scene.start.string_state = string_state;
      const State<double> plain = run(losing(0.0, 0.0), scene.start, at, 0.5, 500);
      State<double> slowed = run(losing(0.0, 40.0), scene.start, at, 0.5, 500);
      CHECK(plain.spin == 80.0);
      CHECK(slowed.spin == Approx(60.0).epsilon(1e-12));
      slowed.spin = plain.spin;
      CHECK(same_bits(slowed, plain));
    }
  }
}

TEST_CASE("beside a driving string the spin settles where both agree") {
  // Tips in one place and a steady string: k (0 - w) - air w |w| has no rest but zero, along
  // w = k / ((k / w0 + air) exp(k t) - air).
  const double k = 0.8, air = 5e-3, start = 120.0, time = 1.0;
  Tips<double> tips;
  tips.left = tips.right = Vector(0.0, 0.0, 1.0);
  State<double> state;
  state.position = Vector(0.0, 0.0, 0.275);
  state.spin = start;
  state.string_state = StringState::kOnString;
  const auto at = [&](double) { return tips; };
  const double exact = k / ((k / start + air) * std::exp(k * time) - air);
  const double coarse = run(losing(air, 0.0, k), state, at, time, 1000).spin - exact,
               fine = run(losing(air, 0.0, k), state, at, time, 2000).spin - exact;
  CHECK(std::abs(coarse) < 1e-3 * exact);
  CHECK(coarse / fine == Approx(2.0).epsilon(0.02));
}

TEST_CASE("mirrored and turned, spin is lost as before") {
  const unsigned seed = 742;
  CAPTURE(seed);
  const Full model = losing(1e-3, 10.0, 0.5);
  const auto mirror = [](const auto& x) { return mirrored(x); };
  CHECK(worst_of_symmetry(model, model, mirror, mirror, seed) < 1e-9);
  const Eigen::Matrix3d turn = about_vertical(0.7);
  const auto rotate = [&](const auto& x) { return turned(x, turn); };
  CHECK(worst_of_symmetry(model, model, rotate, rotate, seed) < 1e-9);
}
