// SPDX-License-Identifier: MIT
#include "diabolo/effects/residual_force.hpp"

#include "diabolo/math/dual.hpp"
#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

using Residual = ResidualForce<double>;

/// Weights of either sign; ranges in which all of a scene lies, or as wide as usual in play.
ResidualLaw random_law(Random& random, double weight, double wide) {
  ResidualLaw law;
  law.largest = random.uniform(0.5, 3.0);
  law.power = random.uniform(0.1, 2.0);
  for (ResidualPart* part : {&law.on_string, &law.off_string}) {
    for (double& one : part->weights) one = random.uniform(-weight, weight);
    for (std::size_t i = 0; i < kResidualInputs; ++i) {
      part->low[i] = -wide * random.uniform(0.5, 1.0);
      part->high[i] = wide * random.uniform(0.5, 1.0);
    }
  }
  return law;
}

/// Everywhere, however large.
ResidualLaw unbounded_law(Random& random) {
  ResidualLaw law = random_law(random, 0.1, 900.0);
  law.largest = ResidualLaw::kLargest.maximum;
  law.power = ResidualLaw::kPower.maximum;
  return law;
}

Vector push(const ResidualLaw& law, const State<double>& state, const Tips<double>& tips) {
  return Residual(law).acceleration(state, tips, 1e-3, Numbers());
}

struct Instant {
  State<double> state;
  Tips<double> tips;
};

Instant random_instant(Random& random) {
  const Scene scene = hanging_scene(random);
  Instant instant{scene.start, scene.tips.at(0.0)};
  instant.state.velocity = random.vector(2.0);
  instant.state.string_acceleration = random.vector(12.0);
  instant.state.string_state = static_cast<StringState>(random.index(3));
  return instant;
}

/// As the mirror shows it: what pushes to the right, and across by the slip, is turned round.
ResidualLaw mirrored(ResidualLaw law) {
  for (ResidualPart* part : {&law.on_string, &law.off_string}) {
    for (const std::size_t odd : {residual_begin(0), residual_begin(2) - 1}) part->weights[odd] *= -1.0;
    for (const std::size_t i : {0, 3, 5, 7}) {
      std::swap(part->low[i], part->high[i]);
      part->low[i] *= -1.0;
      part->high[i] *= -1.0;
    }
  }
  return law;
}

}  // namespace

TEST_CASE("a residual without weights changes no bit") {
  const unsigned seed = 900;
  CAPTURE(seed);
  Full::Set set;
  set.get<ResidualForce>() = Residual(ResidualLaw());
  CHECK(differing_steps(set, seed) == 0);
  ResidualLaw law;
  law.on_string.weights[0] = law.off_string.weights[0] = 1e-3;
  for (ResidualPart* part : {&law.on_string, &law.off_string}) {
    part->low.fill(-100.0);
    part->high.fill(100.0);
  }
  set.get<ResidualForce>() = Residual(law);
  CHECK(differing_steps(set, seed) > 1000);
}

TEST_CASE("turned about the vertical, moved and seen in a mirror, a residual is the same") {
  const unsigned seed = 901;
  CAPTURE(seed);
  Random random(seed);
  for (int i = 0; i < 200; ++i) {
    const ResidualLaw law = random_law(random, 1.0, 2.0);
    const Instant at = random_instant(random);
    const Vector here = push(law, at.state, at.tips);
    const Eigen::Matrix3d turn = about_vertical(random.uniform(-3.0, 3.0));
    CHECK((push(law, turned(at.state, turn), turned(at.tips, turn)) - turn * here).norm() < 1e-11);
    Instant moved = at;
    const Vector by = random.vector(5.0);
    for (Vector* place : {&moved.state.position, &moved.tips.left, &moved.tips.right}) *place += by;
    CHECK((push(law, moved.state, moved.tips) - here).norm() < 1e-11);
    using effect_scene::mirrored;
    CHECK((push(::mirrored(law), mirrored(at.state), mirrored(at.tips)) - mirrored(here)).norm() < 1e-11);
  }
}

TEST_CASE("a residual fades out where nothing was seen") {
  const unsigned seed = 902;
  CAPTURE(seed);
  Random random(seed);
  for (int i = 0; i < 100; ++i) {
    ResidualLaw law = unbounded_law(random);
    Instant at = random_instant(random);
    const auto& inputs = residual_scene(at.state, at.tips, Numbers()).inputs;
    const Vector inside = push(law, at.state, at.tips);
    REQUIRE(inside.norm() > 1e-3);
    const std::size_t k = static_cast<std::size_t>(random.index(static_cast<int>(kResidualInputs)));
    double before = inside.norm();
    for (const double widths : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 5.0}) {  // half widths beyond the range
      for (ResidualPart* part : {&law.on_string, &law.off_string}) {
        part->high[k] = inputs[k] - widths;
        part->low[k] = part->high[k] - 2.0;
      }
      const double size = push(law, at.state, at.tips).norm();
      CHECK(size <= before * (1.0 + 1e-9));
      if (widths >= 1.0) CHECK(size < 1e-12);
      before = size;
    }
  }
}

TEST_CASE("neither a residual nor its work is larger than it may be") {
  const unsigned seed = 903;
  CAPTURE(seed);
  Random random(seed);
  int held = 0, working = 0;
  for (int i = 0; i < 2000; ++i) {
    const ResidualLaw law = random_law(random, 10.0, 20.0);
    const Instant at = random_instant(random);
    const Vector here = push(law, at.state, at.tips);
    const double work = here.dot(at.state.velocity);
    CHECK(here.norm() <= law.largest * (1.0 + 1e-12));
    CHECK(work <= law.power * (1.0 + 1e-9));
    held += here.norm() > 0.999 * law.largest;
    working += work > 0.999 * law.power;
  }
  CHECK(held > 100);
  CHECK(working > 100);
}

TEST_CASE("derivatives of a residual by the state are those of its values") {
  using D = Dual<double, 6>;
  const unsigned seed = 904;
  CAPTURE(seed);
  Random random(seed);
  for (int i = 0; i < 50; ++i) {
    const ResidualLaw law = unbounded_law(random);
    const Instant at = random_instant(random);
    ResidualForce<D> force;
    force.take_text(Residual(law));
    State<D> state = state_in<D>(at.state);
    for (int k = 0; k < 3; ++k) {
      state.position[k].gradient[k] = 1.0;
      state.velocity[k].gradient[3 + k] = 1.0;
    }
    Tips<D> tips;
    tips.left = at.tips.left.cast<D>();
    tips.right = at.tips.right.cast<D>();
    tips.left_velocity = at.tips.left_velocity.cast<D>();
    tips.right_velocity = at.tips.right_velocity.cast<D>();
    const Vector3<D> there = force.acceleration(state, tips, D(1e-3), parameters_in<D>(Numbers()));
    for (int k = 0; k < 6; ++k) {
      const double h = 1e-6;
      State<double> more = at.state, less = at.state;
      (k < 3 ? more.position[k] : more.velocity[k - 3]) += h;
      (k < 3 ? less.position[k] : less.velocity[k - 3]) -= h;
      const Vector slope = (push(law, more, at.tips) - push(law, less, at.tips)) / (2.0 * h);
      for (int c = 0; c < 3; ++c) CHECK(there[c].gradient[k] == Approx(slope[c]).margin(1e-5));
    }
  }
}

TEST_CASE("plays with a residual stay finite, and gain no more energy than it may do work") {
  const unsigned seed = 905;
  CAPTURE(seed);
  Random random(seed);
  for (int play = 0; play < 60; ++play) {
    const Full model = [&] {
      Full::Set set;
      set.get<ResidualForce>() = Residual(random_law(random, 5.0, 3.0));
      return Full(Numbers(), set);
    }();
    Scene scene = hanging_scene(random);
    const Tips<double> still{scene.tips.at(0.0).left, scene.tips.at(0.0).right, Vector::Zero(),
                             Vector::Zero()};
    State<double> state = scene.start;
    const auto energy = [&] { return 0.5 * state.velocity.squaredNorm() + 9.81 * state.position.z(); };
    const double before = energy(), power = model.effects().get<ResidualForce>().law->power;
    for (int k = 0; k < 5000; ++k) model.step(state, still, still, 1e-3);
    CHECK(energy() - before < power * 5.0 + 1e-2);
    for (int k = 0; k < 5000; ++k)
      model.step(state, scene.tips.at(k * 1e-3), scene.tips.at((k + 1) * 1e-3), 1e-3);
    CHECK((state.position.allFinite() && state.velocity.allFinite()));
  }
}

TEST_CASE("a residual out of its range is refused") {
  ResidualLaw law;
  law.largest = 100.0;
  CHECK_THROWS_WITH(Residual(law), "residual largest: 100; must be within [1e-06, 20]");
  law = {};
  law.off_string.low[2] = 1.0;
  CHECK_THROWS_WITH(Residual(law), "residual off_string high: 0; must be within [1, 1000]");
}
