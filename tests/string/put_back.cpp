// SPDX-License-Identifier: MIT
#include "diabolo/string/put_back.hpp"

#include "catch.hpp"
#include "random.hpp"
#include "step_case.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

StringStepResult<double> put_back_of(const StepCase& scene) {
  StringStepResult<double> result;
  result.string_acceleration = Vector::Ones();
  put_back(scene.step(), true, result);
  return result;
}

/// On or in the spheroid of resting tips, on the way out of it.
bool going_out(Random& random, StepCase& scene) {
  const double distance =
      random.chance(0.5) ? random.uniform(0.0, 1.4) : scene.length * (1.0 - random.log_uniform(1e-10, 1e-2));
  const Vector center = random.vector(0.5), half = random.direction() * (0.5 * distance);
  scene.rest(center + half, center - half);
  scene.position = random.reachable({scene.begin.left, scene.begin.right, scene.length});
  scene.velocity = random.arrow(0.1, 1e3);
  scene.dt = random.log_uniform(1e-4, 1e-2);
  return scene.path(scene.step().free_position(scene.dt)) > scene.length;
}

}  // namespace

TEST_CASE("the diabolo ends on the string, on the line it moved along, and without more energy") {
  Random random(90);
  double beyond = 0.0, off_line = 0.0, gain = -1.0;
  for (int i = 0; i < 3000; ++i) {
    StepCase scene;
    if (!going_out(random, scene)) continue;
    const StringStepResult<double> result = put_back_of(scene);
    const Vector way = scene.step().free_position(scene.dt) - scene.position;
    beyond = std::max(beyond, scene.path(result.position) - scene.length);
    off_line = std::max(off_line, (result.position - scene.position).cross(way.normalized()).norm());
    const double potential = -scene.acceleration.dot(result.position - scene.position);
    const double kinetic = 0.5 * (result.velocity.squaredNorm() - scene.velocity.squaredNorm());
    gain = std::max(gain, (potential + kinetic) / (1.0 + scene.velocity.squaredNorm()));
    const Vector impulse = result.velocity - scene.step().free_velocity(scene.dt);
    CHECK((result.string_acceleration * scene.dt - impulse).norm() < 1e-12 * (1.0 + impulse.norm()));
    const auto imbalance = [&](const Vector& at) {
      return (at - scene.begin.right).norm() - (at - scene.begin.left).norm();
    };
    const double passed = 0.5 * (imbalance(result.position) - imbalance(scene.position));
    CHECK(result.passed == Approx(passed).margin(1e-12));
  }
  CHECK(beyond <= 1.0000001 * constraint_tolerance<double>() * 1.45);
  CHECK(off_line < 1e-12);
  CHECK(gain < 1e-14);  // relative to the energy at hand
}

TEST_CASE("where the tips have left the diabolo outside, it is drawn towards their midpoint") {
  StepCase scene;
  scene.rest({0.0, 0.2, 1.0}, {0.0, -0.2, 1.0});
  scene.begin.left.z() = scene.begin.right.z() = 0.3;
  scene.position = Vector(0.0, 0.0, -0.3);
  const StringStepResult<double> result = put_back_of(scene);
  CHECK(scene.path(result.position) == Approx(scene.length).epsilon(1e-9));
  CHECK(std::abs(result.position.x()) < 1e-12);
  CHECK(std::abs(result.position.y()) < 1e-12);
  CHECK(result.position.z() > scene.position.z());
}

TEST_CASE("the path of what is put back does not grow on") {
  Random random(91);
  for (int i = 0; i < 300; ++i) {
    StepCase scene;
    if (!going_out(random, scene)) continue;
    const StringStepResult<double> result = put_back_of(scene);
    const StringPath<double> path(result.position, scene.end);
    const double rate = path.rate(result.velocity, Vector::Zero(), Vector::Zero());
    // 1e-12 under the squared gradient leaves a share of the rate where the spheroid is thinnest.
    const double share = 1e-12 / (path.gradient().squaredNorm() + 1e-12);
    CHECK(std::abs(rate) <= 1e-11 * (1.0 + scene.velocity.norm()) +
                                share * path.gradient().norm() * scene.velocity.norm() * 1.1);
  }
}

TEST_CASE("lanes outside the mask are left alone") {
  StepCase scene;
  scene.rest({0.0, 0.2, 1.0}, {0.0, -0.2, 1.0});
  StringStepResult<double> result;
  result.position = Vector(1.0, 2.0, 3.0);
  result.velocity = Vector(4.0, 5.0, 6.0);
  result.string_acceleration = Vector(7.0, 8.0, 9.0);
  put_back(scene.step(), false, result);
  CHECK(result.position == Vector(1.0, 2.0, 3.0));
  CHECK(result.velocity == Vector(4.0, 5.0, 6.0));
  CHECK(result.string_acceleration == Vector(7.0, 8.0, 9.0));
}
