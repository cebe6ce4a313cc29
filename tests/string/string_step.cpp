// SPDX-License-Identifier: MIT
#include "diabolo/string/string_step.hpp"

#include "catch.hpp"
#include "random.hpp"
#include "step_case.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

TEST_CASE("free motion is a parabola") {
  Random random(70);
  StepCase scene;
  scene.position = random.vector(1.0);
  scene.velocity = random.vector(3.0);
  scene.acceleration = random.vector(10.0);
  const StringStep<double> step = scene.step();
  for (const double t : {0.0, 1e-3, 0.5}) {
    const Vector position = scene.position + scene.velocity * t + scene.acceleration * (0.5 * t * t);
    CHECK((step.free_position(t) - position).norm() < 1e-14);
    CHECK((step.free_velocity(t) - scene.velocity - scene.acceleration * t).norm() < 1e-14);
  }
  CHECK(step.free_position(0.0) == scene.position);
}

TEST_CASE("tips within a step lie on straight lines, velocities too") {
  Random random(71);
  StepCase scene;
  scene.begin = {random.vector(1.0), random.vector(1.0), random.vector(1.0), random.vector(1.0)};
  scene.end = {random.vector(1.0), random.vector(1.0), random.vector(1.0), random.vector(1.0)};
  const StringStep<double> step = scene.step();
  CHECK(step.tips_at(0.0).left == scene.begin.left);
  CHECK((step.tips_at(1.0).right - scene.end.right).norm() < 1e-15);
  CHECK((step.tips_at(0.25).left - (scene.begin.left * 0.75 + scene.end.left * 0.25)).norm() < 1e-15);
  CHECK((step.tips_at(0.25).right_velocity -
         (scene.begin.right_velocity * 0.75 + scene.end.right_velocity * 0.25))
            .norm() < 1e-15);
}

TEST_CASE("a plane projector takes the normal part away, or nothing") {
  Random random(72);
  PlaneProjector<double> plane;
  const Vector v = random.vector(2.0);
  CHECK(plane(v) == v);
  plane.active = true;
  plane.normal = random.direction();
  CHECK(std::abs(plane(v).dot(plane.normal)) < 1e-15);
  CHECK((plane(plane(v)) - plane(v)).norm() < 1e-15);
  CHECK((v - plane(v)).cross(plane.normal).norm() < 1e-15);
}

TEST_CASE("a step resolves a soft spring and no rigid string") {
  StepCase scene;
  CHECK(scene.step().resolution(2.0) == 0.0);
  scene.compliance = 1.0;
  CHECK(scene.step().resolution(2.0) == 1.0);
  // The spring's circular frequency is sqrt(|gradient|^2 / compliance); resolved from w dt = 2 downwards.
  const double gradient_squared = 3.0, rate = 2.0 / scene.dt;
  scene.compliance = gradient_squared / (rate * rate);
  CHECK(scene.step().resolution(gradient_squared) == Approx(1.0));
  scene.compliance *= 0.5;
  CHECK(scene.step().resolution(gradient_squared) == Approx(0.5));
}

TEST_CASE("an inelastic string leaves no rate of the path and no push across it") {
  Random random(73);
  for (int i = 0; i < 100; ++i) {
    const Vector velocity = random.vector(5.0), gradient = random.arrow(0.1, 2.0);
    const double tip_rate = random.uniform(-2.0, 2.0), rate = gradient.dot(velocity) + tip_rate;
    const Vector after = without_path_rate(velocity, gradient, rate);
    // 1e-12 keeps the division regular: with |gradient| >= 0.1 it leaves 1e-10 of the rate.
    CHECK(gradient.dot(after) + tip_rate == Approx(0.0).margin(1e-10 * (1.0 + std::abs(rate))));
    CHECK((velocity - after).cross(gradient).norm() < 1e-14);
  }
}
