// SPDX-License-Identifier: MIT
#include "diabolo/string/snap_taut.hpp"

#include "catch.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/math/pack.hpp"
#include "random.hpp"
#include "step_case.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

/// A diabolo that starts somewhere inside and leaves the spheroid within the step; false where it does not.
bool leaves(Random& random, StepCase& scene) {
  scene.dt = random.log_uniform(1e-3, 0.3);
  scene.move({random.vector(0.3), random.vector(0.3), random.vector(1.0), random.vector(1.0)});
  const Spheroid<double> spheroid(scene.begin.left, scene.begin.right, scene.length);
  scene.position = random.reachable(spheroid, 0.0);
  scene.velocity = random.arrow(0.1, 20.0);
  const double begin =
      (scene.position - scene.begin.left).norm() + (scene.position - scene.begin.right).norm();
  return begin < scene.length - 1e-6 && scene.path(scene.step().free_position(scene.dt)) > scene.length;
}

}  // namespace

TEST_CASE("the fraction of the step at which the string comes taut, in closed form") {
  // Tips at one place: the string is taut where the diabolo is half a string length away. No gravity.
  StepCase scene;
  scene.acceleration.setZero();
  scene.position = Vector(0.1, 0.0, 0.0);
  scene.dt = 0.5;
  for (const double speed : {1.3, 2.0, 10.0, 1e3}) {
    scene.velocity = Vector(speed, 0.0, 0.0);
    const double expected = (0.5 * scene.length - 0.1) / speed / scene.dt;
    CHECK(taut_fraction(scene.step(), true) == Approx(expected).epsilon(1e-11));
  }
}

TEST_CASE("at the found fraction the path is as long as the string") {
  Random random(80);
  int found = 0;
  double worst = 0.0;
  while (found < 2000) {
    StepCase scene;
    if (!leaves(random, scene)) continue;
    ++found;
    const StringStep<double> step = scene.step();
    const double fraction = taut_fraction(step, true);
    CHECK(fraction >= 0.0);
    CHECK(fraction <= 1.0);
    const StringPath<double> path(step.free_position(fraction * scene.dt), step.tips_at(fraction));
    worst = std::max(worst, std::abs(path.length() - scene.length));
  }
  CHECK(worst < 0.01 * constraint_tolerance<double>() * 1.45);
}

TEST_CASE("the fraction carries its derivatives") {
  using D = Dual<double, 1>;
  Random random(81);
  int checked = 0;
  while (checked < 50) {
    StepCase scene;
    if (!leaves(random, scene)) continue;
    const double fraction = taut_fraction(scene.step(), true);
    const StringPath<double> path(scene.step().free_position(fraction * scene.dt),
                                  scene.step().tips_at(fraction));
    const Vector at = scene.step().free_velocity(fraction * scene.dt);
    if (path.rate(at, scene.end.left_velocity, scene.end.right_velocity) < 0.5) continue;  // grazing
    ++checked;
    const auto cast = [](const Vector& v) { return Vector3<D>(v.cast<D>()); };
    const auto cast_tips = [&](const Tips<double>& t) {
      return Tips<D>{cast(t.left), cast(t.right), cast(t.left_velocity), cast(t.right_velocity)};
    };
    const Vector3<D> position = cast(scene.position), acceleration = cast(scene.acceleration),
                     none = cast(Vector::Zero());
    Vector3<D> velocity = cast(scene.velocity);
    velocity.x() = D::variable(scene.velocity.x(), 0);
    const Tips<D> begin = cast_tips(scene.begin), end = cast_tips(scene.end);
    const PlaneProjector<D> plane;
    const StringStep<D> step{position,        velocity, acceleration, begin,  end,  D(scene.dt),
                             D(scene.length), none,     D(0.0),       D(0.0), plane};
    const double h = 1e-6;
    StepCase up = scene, down = scene;
    up.velocity.x() += h;
    down.velocity.x() -= h;
    const double difference = (taut_fraction(up.step(), true) - taut_fraction(down.step(), true)) / (2.0 * h);
    // The fraction is exact to 1e-12 / (0.5 m/s * dt), its difference to that over h.
    CHECK(taut_fraction(step, true).gradient[0] == Approx(difference).epsilon(1e-4).margin(1e-3));
  }
}

TEST_CASE("a catch takes the outward rate of the path and nothing else") {
  Random random(82);
  for (int i = 0; i < 300; ++i) {
    StepCase scene;
    scene.move({random.vector(0.3), random.vector(0.3), random.vector(1.0), random.vector(1.0)});
    const Spheroid<double> spheroid(scene.begin.left, scene.begin.right, scene.length);
    const Vector position = random.reachable(spheroid, 1.0), arriving = random.vector(5.0);
    const StringPath<double> path(position, scene.begin);
    const auto rate = [&](const Vector& v) {
      return path.rate(v, scene.begin.left_velocity, scene.begin.right_velocity);
    };
    const Vector leaving = velocity_after_catch(scene.step(), position, arriving, scene.begin);
    if (rate(arriving) <= 0.0) {
      CHECK(leaving == arriving);
    } else {
      CHECK(std::abs(rate(leaving)) < 1e-11);  // restitution 0
      CHECK((leaving - arriving).cross(path.gradient()).norm() < 1e-13);
    }
  }
}

TEST_CASE("a resolved spring takes the catch up itself") {
  StepCase scene;
  scene.rest({0.0, 0.2, 1.0}, {0.0, -0.2, 1.0});
  scene.compliance = 1.0;
  const Vector arriving(0.3, 0.0, -2.0);
  CHECK(velocity_after_catch(scene.step(), Vector(0.0, 0.0, 0.3), arriving, scene.begin) == arriving);
}

TEST_CASE("lanes that stay slack get 0") {
  using P = Pack<double, 4>;
  const auto same = [](double x, double y, double z) { return Vector3<P>(P(x), P(y), P(z)); };
  const Vector3<P> position = same(0.1, 0.0, 0.0), none = same(0.0, 0.0, 0.0);
  Vector3<P> velocity = same(2.0, 0.0, 0.0);
  velocity.x().set(1, -0.1);
  const Tips<P> tips{none, none, none, none};
  const PlaneProjector<P> plane;
  const StringStep<P> step{position, velocity, none,   tips,   tips, P(0.5),
                           P(1.45),  none,     P(0.0), P(0.0), plane};
  const P fraction = taut_fraction(step, velocity.x() > P(0.0));
  CHECK(fraction[0] == Approx(0.625));
  CHECK(fraction[1] == 0.0);
}
