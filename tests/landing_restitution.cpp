// SPDX-License-Identifier: MIT
#include "diabolo/effects/landing_restitution.hpp"

#include <cmath>
#include <limits>

#include "diabolo/dual.hpp"
#include "diabolo/pack.hpp"
#include "effect_scene.hpp"

using namespace effect_scene;

namespace {

/// Under the middle of resting tips, `drop` above the lowest point of the string.
struct Drop {
  Tips<double> tips;
  State<double> state;
  double lowest;
};

Drop drop_from(double drop) {
  Drop scene;
  scene.tips.left = Vector(0.0, 0.2, 1.0);
  scene.tips.right = Vector(0.0, -0.2, 1.0);
  scene.lowest = 1.0 - std::sqrt(0.25 * 1.45 * 1.45 - 0.04);
  scene.state.position = Vector(0.0, 0.0, scene.lowest + drop);
  scene.state.string_state = StringState::kLoose;
  return scene;
}

/// Highest point after the first catch, above the lowest point of the string [m].
double bounce(double coefficient, double drop, double dt) {
  const Full model = full<LandingRestitution>([&](auto& effect) { effect.coefficient = coefficient; });
  Drop scene = drop_from(drop);
  bool caught = false;
  double highest = 0.0, velocity = 0.0;
  for (double t = 0.0; t < 1.0; t += dt) {
    const bool snapped = model.step(scene.state, scene.tips, scene.tips, dt).snapped_taut;
    if (snapped && caught) return highest;
    caught = caught || snapped;
    if (caught) highest = std::max(highest, scene.state.position.z() - scene.lowest);
    if (caught && velocity > 0.0 && scene.state.velocity.z() <= 0.0) return highest;
    velocity = scene.state.velocity.z();
  }
  return highest;
}

}  // namespace

TEST_CASE("a catch without restitution changes no bit") {
  const unsigned seed = 1021;
  CAPTURE(seed);
  Full::Set set;
  CHECK(differing_steps(set, seed) == 0);
}

TEST_CASE(
    "a dropped diabolo comes back to the square of the coefficient times its height, as dt goes to zero") {
  for (const double e : {0.2, 0.5, 0.9}) {
    CAPTURE(e);
    const double expected = e * e * 0.1;
    CHECK(bounce(e, 0.1, 1e-5) == Approx(expected).epsilon(2e-3));
    CHECK(std::abs(bounce(e, 0.1, 1e-4) - expected) < 3e-3 * 0.1);
    CHECK(std::abs(bounce(e, 0.1, 1e-3) - expected) < 3e-2 * 0.1);
  }
}

/// Kinetic and potential energy per mass [J/kg].
template <class Scalar>
double energy(const State<Scalar>& state, double gravity) {
  return 0.5 * state.velocity.template cast<double>().squaredNorm() +
         gravity * static_cast<double>(state.position.z());
}

TEMPLATE_TEST_CASE("no bounce on resting tips gains energy, whatever the coefficient and the step", "",
                   double, float) {
  const unsigned seed = 1023;
  CAPTURE(seed);
  Random random(seed);
  const double epsilon = static_cast<double>(std::numeric_limits<TestType>::epsilon());
  int bounced = 0;
  for (int episode = 0; episode < 400; ++episode) {
    const double e = episode % 4 == 0 ? 1.0 : random.uniform(0.0, 1.0), dt = random.log_uniform(1e-4, 2e-2);
    EffectSet<TestType, LandingRestitution> set;
    set.template get<LandingRestitution>().coefficient = static_cast<TestType>(e);
    const Parameters<TestType> parameters;
    const Predictor<TestType, LandingRestitution> model(parameters, set);
    const double length = static_cast<double>(parameters.string_length),
                 gravity = static_cast<double>(parameters.gravity);
    const Vector center = random.vector(0.5),
                 half = random.direction() * (0.5 * length * random.uniform(0.05, 0.95));
    Tips<TestType> tips;
    tips.left = (center + half).cast<TestType>();
    tips.right = (center - half).cast<TestType>();
    State<TestType> state;
    state.position = random.reachable({center + half, center - half, length}).template cast<TestType>();
    state.velocity = random.arrow(1e-2, 10.0).cast<TestType>();
    state.string_state = StringState::kLoose;
    for (int i = 0; i < 300; ++i) {
      const double before = energy(state, gravity);
      bounced += model.step(state, tips, tips, static_cast<TestType>(dt)).snapped_taut;
      CAPTURE(episode, i, e, dt);
      // What a step ignores, and the rounding of the energies themselves [J/kg].
      REQUIRE(energy(state, gravity) - before <
              static_cast<double>(energy_tolerance<TestType>()) + 16.0 * epsilon * (before + 100.0));
    }
  }
  CHECK(bounced > 1000);
}

TEST_CASE("a catch sends the path's rate back by the coefficient, and leaves what is along the string") {
  const unsigned seed = 1024;
  CAPTURE(seed);
  Random random(seed);
  for (int episode = 0; episode < 200; ++episode) {
    const double e = random.uniform(0.0, 1.0), dt = 1e-7;
    const Full model = full<LandingRestitution>([&](auto& effect) { effect.coefficient = e; }, weightless());
    Drop scene = drop_from(0.0);
    const Spheroid<double> spheroid(scene.tips.left, scene.tips.right, model.parameters().string_length);
    const Vector at = spheroid.closest_point(spheroid.center() + random.vector(0.3) - Vector(0.0, 0.0, 1.0));
    const Vector outward = spheroid.normal(at),
                 arriving = outward * random.uniform(0.5, 5.0) + random.vector(2.0);
    if (arriving.dot(outward) < 0.1) continue;
    scene.state.position = at - arriving * (0.5 * dt);
    scene.state.velocity = arriving;
    const bool snapped = model.step(scene.state, scene.tips, scene.tips, dt).snapped_taut;
    REQUIRE(snapped);
    const Vector expected = arriving - outward * ((1.0 + e) * arriving.dot(outward));
    CHECK((scene.state.velocity - expected).norm() < 1e-5 * arriving.norm());  // the path turns by |v| dt / m
  }
}

TEST_CASE("a diabolo that bounces on resting tips comes to rest on the string") {
  const Full model = full<LandingRestitution>([](auto& effect) { effect.coefficient = 0.4; });
  Drop scene = drop_from(0.15);
  scene.state.position.y() += 0.03;
  for (int i = 0; i < 3000; ++i) model.step(scene.state, scene.tips, scene.tips, 1e-3);
  CHECK(scene.state.string_state == StringState::kOnString);
}

TEST_CASE("a catch bounces as it does beside a taut lane, where hands that give way leave the string slack") {
  using Lanes = Pack<double, 2>;
  const unsigned seed = 1022;
  CAPTURE(seed);
  Random random(seed);
  EffectSet<double, LandingRestitution> set;
  set.get<LandingRestitution>().coefficient = 0.5;
  EffectSet<Lanes, LandingRestitution> lanes_set;
  lanes_set.get<LandingRestitution>().coefficient = Lanes(0.5);
  const Predictor<double, LandingRestitution> model(Numbers(), set);
  const Predictor<Lanes, LandingRestitution> lanes_model(Parameters<Lanes>(), lanes_set);
  constexpr double kStep = 1e-3;
  int bounced = 0;
  for (int i = 0; i < 4000; ++i) {
    Drop scene = drop_from(random.uniform(0.0, 1e-3));
    const double speed = random.uniform(-2.0, 2.0), acceleration = random.uniform(-40.0, 40.0);
    for (Vector* velocity : {&scene.tips.left_velocity, &scene.tips.right_velocity}) velocity->z() = speed;
    Tips<double> end = scene.tips;
    for (Vector* tip : {&end.left, &end.right})
      tip->z() += speed * kStep + 0.5 * acceleration * kStep * kStep;
    for (Vector* velocity : {&end.left_velocity, &end.right_velocity}) velocity->z() += acceleration * kStep;
    scene.state.velocity = Vector(0.0, 0.0, random.uniform(-2.0, 0.0));
    // Beside it one that hangs on the string that the hands pull up.
    State<Lanes> lanes;
    for (int k = 0; k < 3; ++k) lanes.position[k] = Lanes(scene.state.position[k]);
    lanes.position[2].set(1, scene.lowest);
    lanes.velocity[2].set(0, scene.state.velocity.z());
    lanes.velocity[2].set(1, speed - 1.0);
    lanes.string_state.code.set(0, static_cast<double>(StringState::kLoose));
    lanes.string_state.code.set(1, static_cast<double>(StringState::kOnString));
    const auto both = [](const Tips<double>& tips) {
      return Tips<Lanes>{tips.left.cast<Lanes>(), tips.right.cast<Lanes>(), tips.left_velocity.cast<Lanes>(),
                         tips.right_velocity.cast<Lanes>()};
    };
    const bool snapped = model.step(scene.state, scene.tips, end, kStep).snapped_taut;
    lanes_model.step(lanes, both(scene.tips), both(end), Lanes(kStep));
    bounced += snapped;
    REQUIRE(lanes.velocity[2][0] == scene.state.velocity.z());
    REQUIRE(lanes.position[2][0] == scene.state.position.z());
  }
  CHECK(bounced > 500);
}

TEST_CASE("a taut string feels no restitution") {
  Random random(1022);
  const Scene scene = hanging_scene(random);
  const auto tips = [&](double t) { return scene.tips.at(t); };
  const Full bouncy = full<LandingRestitution>([](auto& effect) { effect.coefficient = 0.8; });
  const State<double> with = run(bouncy, scene.start, tips, 0.02, 20),
                      without = run(Full(Numbers()), scene.start, tips, 0.02, 20);
  CHECK(with.position == without.position);
}

TEST_CASE("the derivative by the coefficient is the bounce's own") {
  using D = Dual<double, 1>;
  const auto height = []<class Scalar>(const Scalar& coefficient) {
    typename FullPredictor<Scalar>::Set set;
    set.template get<LandingRestitution>().coefficient = coefficient;
    const FullPredictor<Scalar> model(Parameters<Scalar>(), set);
    const Drop scene = drop_from(0.1);
    State<Scalar> state;
    state.position = scene.state.position.cast<Scalar>();
    state.string_state = StringState::kLoose;
    Tips<Scalar> tips;
    tips.left = scene.tips.left.cast<Scalar>();
    tips.right = scene.tips.right.cast<Scalar>();
    for (int i = 0; i < 180; ++i) model.step(state, tips, tips, Scalar(1e-3));
    return Scalar(state.position.z());
  };
  const D at = height(D::variable(0.5, 0));
  CHECK(at.value == height(0.5));
  CHECK(at.gradient[0] == Approx((height(0.5 + 1e-6) - height(0.5 - 1e-6)) / 2e-6).epsilon(1e-6));
  CHECK(at.gradient[0] > 0.03);
}
