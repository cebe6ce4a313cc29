// SPDX-License-Identifier: MIT
#include "diabolo/effects/gravity_tilt.hpp"

#include "diabolo/math/shortest_turn.hpp"

#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

Full tilted(double x, double y, const Numbers& parameters = {}) {
  return full<GravityTilt>(
      [&](auto& tilt) {
        tilt.x = x;
        tilt.y = y;
      },
      parameters);
}

/// The shortest rotation of straight down onto the tilted gravity.
Eigen::Matrix3d rotation_to(double x, double y) {
  const Vector down(0.0, 0.0, -1.0), there(x, y, -std::sqrt(1.0 - x * x - y * y));
  return diabolo::shortest_turn(down, there).toRotationMatrix();
}

}  // namespace

TEST_CASE("gravity that is not tilted changes no bit") {
  const unsigned seed = 750;
  CAPTURE(seed);
  Full::Set set;
  CHECK(differing_steps(set, seed) == 0);
  set.get<GravityTilt>().x = 1e-8;
  CHECK(differing_steps(set, seed) > 1000);
  set.get<GravityTilt>().x = 0.0;
  set.get<GravityTilt>().y = 1e-8;
  CHECK(differing_steps(set, seed) > 1000);
}

TEST_CASE("tilted gravity has the stated components and its old size") {
  const unsigned seed = 751;
  CAPTURE(seed);
  Random random(seed);
  for (int i = 0; i < 50; ++i) {
    const double x = random.uniform(-0.5, 0.5), y = random.uniform(-0.5, 0.5);
    const Full model = tilted(x, y);
    const Vector sum =
        model.effects().acceleration(State<double>(), Tips<double>(), 1e-3, model.parameters());
    CHECK(sum.x() == Approx(x * kStandardGravity));
    CHECK(sum.y() == Approx(y * kStandardGravity));
    CHECK(sum.z() < 0.0);
    CHECK(sum.norm() == Approx(kStandardGravity).epsilon(1e-14));
  }
}

TEST_CASE("a flight is the parabola of the tilted gravity, to rounding") {
  const double x = 0.03, y = -0.02;
  const Vector v0(1.0, 2.0, 3.0);
  const State<double> end = fly(tilted(x, y), flying(v0), 0.7, 70);
  const Vector gravity = Vector(x, y, -std::sqrt(1.0 - x * x - y * y)) * kStandardGravity;
  const Vector parabola = Vector(0.0, 0.0, 100.0) + v0 * 0.7 + gravity * (0.5 * 0.49);
  CHECK((end.position - parabola).norm() < 1e-12);
  CHECK((end.velocity - v0 - gravity * 0.7).norm() < 1e-12);
}

TEST_CASE("a diabolo at rest hangs along the tilted gravity") {
  for (const double x : {0.0, 0.0175, -0.2})
    for (const double y : {0.0, 0.1}) {
      Numbers parameters;
      parameters.dissipation_rate = 3.0;
      Tips<double> tips;
      tips.left = tips.right = Vector(0.0, 0.0, 1.0);
      State<double> state;
      state.position = Vector(0.0, 0.0, 0.275);
      state.string_state = StringState::kOnString;
      state = run(
          tilted(x, y, parameters), state, [&](double) { return tips; }, 15.0, 15000);
      CAPTURE(x, y);
      const Vector expected = tips.left + Vector(x, y, -std::sqrt(1.0 - x * x - y * y)) * 0.725;
      CHECK((state.position - expected).norm() < 1e-7);
    }
}

TEST_CASE("play under tilted gravity is the play of the rotated scene") {
  const unsigned seed = 752;
  CAPTURE(seed);
  Random random(seed);
  for (int i = 0; i < 4; ++i) {
    const double x = random.uniform(-0.2, 0.2), y = random.uniform(-0.2, 0.2);
    const Eigen::Matrix3d turn = rotation_to(x, y);
    const auto rotate = [&](const auto& v) { return turned(v, turn); };
    CHECK(worst_of_symmetry(tilted(0.0, 0.0), tilted(x, y), rotate, rotate, seed) < 1e-9);
    CHECK(worst_of_symmetry(tilted(0.0, 0.0), tilted(0.0, 0.0), rotate, rotate, seed) > 1e-3);
  }
}

TEST_CASE("mirrored and turned with it, tilted gravity acts as before") {
  const unsigned seed = 753;
  CAPTURE(seed);
  const Full model = tilted(0.05, 0.1);
  const auto mirror = [](const auto& v) { return mirrored(v); };
  CHECK(worst_of_symmetry(model, tilted(0.05, -0.1), mirror, mirror, seed) < 1e-9);
  const Eigen::Matrix3d turn = about_vertical(0.7);
  const Vector sine = turn * Vector(0.05, 0.1, 0.0);
  const auto rotate = [&](const auto& v) { return turned(v, turn); };
  CHECK(worst_of_symmetry(model, tilted(sine.x(), sine.y()), rotate, rotate, seed) < 1e-9);
}

TEST_CASE("tilted gravity keeps the second order of the step") {
  const unsigned seed = 754;
  CAPTURE(seed);
  Random random(seed);
  for (int episode = 0; episode < 5; ++episode) {
    const Scene scene = hanging_scene(random);
    CAPTURE(episode);
    CHECK(halving_ratio(tilted(0.05, -0.03), scene, 250, apart) == Approx(4.0).epsilon(0.1));
  }
}
