// SPDX-License-Identifier: MIT
#include "diabolo/string/keep_energy.hpp"

#include "catch.hpp"
#include "random.hpp"
#include "step_case.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

/// A step by an impulse along the discrete gradient towards any end.
struct Pulled {
  StepCase scene;
  double impulse = 0.0;
  Vector end = Vector::Zero();

  StringPath<double> begin_path() const { return {scene.position, scene.begin}; }
  StringPath<double> end_path() const { return {end, scene.end}; }
  Vector velocity() const {
    return scene.step().free_velocity(scene.dt) - discrete_gradient(begin_path(), end_path()) * impulse;
  }
  Vector kept(bool where = true) const {
    Vector result = velocity();
    keep_energy<double>(scene.step(), begin_path(), end_path(), impulse, where, result);
    return result;
  }
  /// Energy per mass that the step gains [J/kg], ending where these velocities lead, on resting tips.
  double gain(const Vector& velocity_at_end) const {
    const Vector travel = (scene.velocity + velocity()) * (0.5 * scene.dt);
    return 0.5 * (velocity_at_end.squaredNorm() - scene.velocity.squaredNorm()) -
           scene.acceleration.dot(travel);
  }
};

Pulled random_pull(Random& random) {
  Pulled pull;
  StepCase& scene = pull.scene;
  const double distance = scene.length * (1.0 - random.log_uniform(1e-9, 1.0));
  const Vector center = random.vector(0.5), half = random.direction() * (0.5 * distance);
  scene.rest(center + half, center - half);
  scene.position = random.reachable({scene.begin.left, scene.begin.right, scene.length}, 1.0);
  scene.velocity = random.arrow(0.1, 30.0);
  scene.dt = random.log_uniform(1e-4, 1e-2);
  pull.end = random.reachable({scene.begin.left, scene.begin.right, scene.length}, 1.0);
  pull.impulse = random.log_uniform(1e-3, 10.0);
  return pull;
}

}  // namespace

TEST_CASE("of a step on resting tips no gain of energy is left, and a loss is none of its business") {
  Random random(400);
  int gains = 0, losses = 0;
  double left_over = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const Pulled pull = random_pull(random);
    const Vector before = pull.velocity(), after = pull.kept();
    const double gain = pull.gain(before), scale = 1.0 + before.squaredNorm();
    CAPTURE(i, gain, scale);
    if (gain > energy_tolerance<double>() + 1e-12 * scale) {
      ++gains;
      CHECK(before.cross(after).norm() <= 1e-14 * before.squaredNorm());
      // Where a step leads so high that no speed is left, its end is at fault.
      if (gain < 0.5 * before.squaredNorm())
        left_over = std::max(left_over, std::abs(pull.gain(after)) / scale);
      else
        CHECK(after.norm() < 1e-100);
    } else if (gain < energy_tolerance<double>() - 1e-12 * scale) {
      ++losses;
      CHECK(after == before);
    }
    CHECK(pull.kept(false) == before);
  }
  CHECK(gains > 500);
  CHECK(losses > 500);
  CHECK(left_over < 1e-13);
}

TEST_CASE("what moving tips do is no gain") {
  // The same step seen from a frame in uniform motion: the same change of length, times the same tension.
  Random random(401);
  for (int i = 0; i < 1000; ++i) {
    const Pulled resting = random_pull(random);
    const double gain = resting.gain(resting.velocity());
    Pulled moving = resting;
    const Vector frame = random.vector(3.0), moved = frame * moving.scene.dt;
    moving.scene.velocity += frame;
    moving.scene.end.left += moved;
    moving.scene.end.right += moved;
    moving.end += moved;
    const Vector velocity = moving.velocity();
    const double taken = 0.5 * (velocity.squaredNorm() - moving.kept().squaredNorm());
    const double expected =
        gain > energy_tolerance<double>() ? std::min(gain, 0.5 * velocity.squaredNorm()) : 0.0;
    CAPTURE(i, gain);
    CHECK(taken == Approx(expected).epsilon(1e-9).margin(2.0 * energy_tolerance<double>() +
                                                         1e-12 * velocity.squaredNorm()));
  }
}
