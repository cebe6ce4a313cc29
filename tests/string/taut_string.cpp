// SPDX-License-Identifier: MIT
#include "diabolo/string/taut_string.hpp"

#include "catch.hpp"
#include "diabolo/math/pack.hpp"
#include "lane.hpp"
#include "random.hpp"
#include "step_case.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

StringStepResult<double> advance(const StepCase& scene, bool captured = true) {
  return advance_on_string<false>(scene.step(), captured);
}

/// Slack and passed string are read one iteration before the last, which moves the diabolo by no more than
/// about the square root of the constraint's tolerance [m].
constexpr double kNearEnd = 2e-5;

/// A state on or in the spheroid of tips that move a little within the step.
StepCase random_case(Random& random) {
  StepCase scene;
  scene.dt = random.log_uniform(2e-4, 5e-3);
  scene.length = random.uniform(0.5, 2.0);
  const double half_distance = random.uniform(0.0, 0.49) * scene.length;
  const Vector center = random.vector(0.5), half = random.direction() * half_distance;
  scene.move({center + half, center - half, random.vector(1.0), random.vector(1.0)});
  scene.position = random.reachable({scene.begin.left, scene.begin.right, scene.length});
  scene.velocity = random.arrow(1e-2, 5.0);
  return scene;
}

}  // namespace

TEST_CASE("a diabolo that hangs at rest stays there, and the string carries it") {
  for (const double distance : {0.0, 0.1, 0.5, 1.0, 1.3, 1.44}) {
    StepCase scene;
    scene.rest({0.0, 0.5 * distance, 1.0}, {0.0, -0.5 * distance, 1.0});
    const Spheroid<double> spheroid(scene.begin.left, scene.begin.right, scene.length);
    scene.position = spheroid.center() - Vector(0.0, 0.0, spheroid.semi_minor());
    for (const double dt : {1e-4, 1e-3, 1e-2}) {
      CAPTURE(distance, dt);
      scene.dt = dt;
      StringStepResult<double> result;
      const Vector start = scene.position;
      StepCase now = scene;
      for (int i = 0; i < 1000; ++i) {
        result = advance(now);
        REQUIRE(result.taut);
        now.position = result.position;
        now.velocity = result.velocity;
        now.guess = result.string_acceleration;
      }
      CHECK((now.position - start).norm() < 1e-9);
      CHECK(now.velocity.norm() < 1e-9);
      CHECK((result.string_acceleration - Vector(0.0, 0.0, kStandardGravity)).norm() < 1e-6);
      // Each strand bears m g / (2 cos of half the angle between them).
      const Vector e1 = (scene.begin.left - start).normalized(),
                   e2 = (scene.begin.right - start).normalized();
      const double cosine = 0.5 * (e1 + e2).norm();
      const double tension = result.string_acceleration.norm() / (e1 + e2).norm();
      CHECK(tension == Approx(kStandardGravity / (2.0 * cosine)).epsilon(1e-7));
    }
  }
}

TEST_CASE("a captured diabolo ends on the taut string or within reach of the slack one") {
  Random random(120);
  double beyond = 0.0, short_of = 0.0;
  int taut = 0, slack = 0, snaps = 0;
  for (int i = 0; i < 20000; ++i) {
    const StepCase scene = random_case(random);
    const StringStepResult<double> result = advance(scene);
    const double excess = scene.path(result.position) - scene.length;
    beyond = std::max(beyond, excess / scene.length);
    if (result.taut) short_of = std::max(short_of, -excess / scene.length);
    taut += result.taut;
    slack += !result.taut;
    snaps += result.snapped_taut;
    CHECK(result.slack == Approx(-excess).margin(kNearEnd));
    if (result.snapped_taut)
      CHECK((scene.position - scene.begin.left).norm() + (scene.position - scene.begin.right).norm() <
            scene.length);
  }
  CHECK(taut > 1000);
  CHECK(slack > 1000);
  CHECK(snaps > 20);
  CHECK(beyond < 1.01 * constraint_tolerance<double>());
  CHECK(short_of < 1.01 * constraint_tolerance<double>());
}

TEST_CASE("the string pulls only inwards, along the plane of its strands") {
  Random random(121);
  for (int i = 0; i < 5000; ++i) {
    const StepCase scene = random_case(random);
    const StringStepResult<double> result = advance(scene);
    if (!result.taut) {
      // Caught and slack again within the step: what it gave in the catch.
      if (!result.snapped_taut) CHECK(result.string_acceleration.isZero(0.0));
      continue;
    }
    const StringPath<double> path(result.position, scene.end);
    // Within a step of some mm the direction turns by some mm over the strand's length.
    if (std::min(path.left_length, path.right_length) > 0.2)
      CHECK(result.string_acceleration.dot(path.gradient()) <= 1e-6);
  }
}

TEST_CASE("after a taut step the rate of the path is gone") {
  Random random(122);
  for (int i = 0; i < 5000; ++i) {
    const StepCase scene = random_case(random);
    const StringStepResult<double> result = advance(scene);
    if (!result.taut) continue;
    const StringPath<double> path(result.position, scene.end);
    if (path.gradient().norm() < 0.05) continue;  // 1e-12 beside its square shows
    const double rate = path.rate(result.velocity, scene.end.left_velocity, scene.end.right_velocity);
    // The gradient is that of the last but one iterate, 1e-5 m away at most.
    CHECK(std::abs(rate) < 1e-4 * (1.0 + result.velocity.norm()));
  }
}

TEST_CASE("a diabolo that is not captured flies freely, through the string") {
  Random random(123);
  for (int i = 0; i < 1000; ++i) {
    const StepCase scene = random_case(random);
    const StringStepResult<double> result = advance(scene, false);
    CHECK(result.position == scene.step().free_position(scene.dt));
    CHECK((result.velocity - scene.step().free_velocity(scene.dt)).norm() == 0.0);
    CHECK_FALSE(result.taut);
    CHECK_FALSE(result.snapped_taut);
    CHECK(result.string_acceleration.isZero(0.0));
  }
}

TEST_CASE("the guess of the string's acceleration changes the result within the tolerance only") {
  Random random(124);
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    StepCase scene = random_case(random);
    const StringPath<double> path(scene.position, scene.begin);
    if (path.gradient().norm() < 0.3) continue;  // where strands point apart, positions are less sharp
    const StringStepResult<double> without = advance(scene);
    scene.guess = without.string_acceleration + random.vector(5.0);
    const StringStepResult<double> with = advance(scene);
    worst = std::max(worst, (with.position - without.position).norm() / scene.length);
  }
  CHECK(worst < 10.0 * constraint_tolerance<double>());
}

TEST_CASE("string that passes the axle is half the change of the strands' difference") {
  Random random(125);
  for (int i = 0; i < 3000; ++i) {
    const StepCase scene = random_case(random);
    const StringStepResult<double> result = advance(scene);
    const StringPath<double> begin(scene.position, scene.begin), end(result.position, scene.end);
    CHECK(result.passed == Approx(0.5 * (end.imbalance() - begin.imbalance())).epsilon(0).margin(kNearEnd));
  }
}

TEST_CASE("without compliance the elastic step gives the bits of the rigid one") {
  Random random(126);
  for (int i = 0; i < 5000; ++i) {
    const StepCase scene = random_case(random);
    const StringStepResult<double> rigid = advance(scene),
                                   elastic = advance_on_string<true>(scene.step(), true);
    const bool same = rigid.position == elastic.position && rigid.velocity == elastic.velocity &&
                      rigid.string_acceleration == elastic.string_acceleration &&
                      rigid.passed == elastic.passed && rigid.taut == elastic.taut &&
                      rigid.snapped_taut == elastic.snapped_taut;
    CHECK(same);
  }
}

TEST_CASE("the usual step at once gives the bits of the whole one, in every lane") {
  constexpr int kLanes = 4;
  using P = Pack<double, kLanes>;
  Vector3<P> position, velocity, guess(P(0), P(0), P(0));
  Tips<P> tips;
  StepCase alone[kLanes];
  for (int k = 0; k < kLanes; ++k) {  // swings of different strings, tips and speeds
    const double apart = 0.1 + 0.1 * k;
    alone[k].length = 1.3 + 0.05 * k;
    alone[k].rest({0.0, apart, 1.0}, {0.0, -apart, 1.0 + 0.03 * k});
    const Spheroid<double> spheroid(alone[k].begin.left, alone[k].begin.right, alone[k].length);
    alone[k].position = spheroid.center() - Vector(0.0, 0.0, spheroid.semi_minor());
    alone[k].velocity = Vector(0.3 * k, 0.1, 0.0);
    set_lane<P>(position, k, alone[k].position);
    set_lane<P>(velocity, k, alone[k].velocity);
    set_lane<P>(tips.left, k, alone[k].begin.left);
    set_lane<P>(tips.right, k, alone[k].begin.right);
  }
  tips.left_velocity = tips.right_velocity = Vector3<P>(P(0), P(0), P(0));
  const Vector3<P> gravity(P(0), P(0), P(-kStandardGravity));
  const P length = [&] {
    P lengths;
    for (int k = 0; k < kLanes; ++k) lengths.set(k, alone[k].length);
    return lengths;
  }();
  const PlaneProjector<P> no_plane;
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const StringStep<P> step{position, velocity, gravity, tips, tips,    P(1e-3),
                             length,   guess,    P(0),    P(0), no_plane};
    const StringStepResult<P> whole = advance_on_string<false>(step, PackMask<double, kLanes>(true));
    StringStepResult<P> at_once;
    const bool usual = advance_at_once<false>(step, at_once);
    hits += usual;
    for (int k = 0; k < kLanes; ++k) {
      CAPTURE(i, k);
      const StringStepResult<double> one = advance(alone[k]);
      const auto same = [&](const StringStepResult<P>& lanes) {
        return lane<P>(lanes.position, k) == one.position && lane<P>(lanes.velocity, k) == one.velocity &&
               lane<P>(lanes.string_acceleration, k) == one.string_acceleration &&
               lanes.passed[k] == one.passed && lanes.slack[k] == one.slack && lanes.taut[k] == one.taut;
      };
      REQUIRE(same(whole));
      if (usual) REQUIRE(same(at_once));
      alone[k].position = one.position;
      alone[k].velocity = one.velocity;
      alone[k].guess = one.string_acceleration;
    }
    position = whole.position;
    velocity = whole.velocity;
    guess = whole.string_acceleration;
  }
  CHECK(hits > 400);
}

TEST_CASE("a diabolo found outside the string is put back without being thrown") {
  StepCase scene;
  scene.rest({0.0, 0.2, 1.0}, {0.0, -0.2, 1.0});
  scene.position = Vector(0.0, 0.0, -0.3);  // 0.6 m too low
  const StringStepResult<double> result = advance(scene);
  CHECK(scene.path(result.position) == Approx(scene.length).epsilon(1e-9));
  CHECK(result.velocity.norm() < 0.1);
}
