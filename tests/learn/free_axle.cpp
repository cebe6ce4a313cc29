// SPDX-License-Identifier: MIT
#include "diabolo/learn/free_axle.hpp"

#include "catch.hpp"
#include "diabolo/batch/batch.hpp"
#include "diabolo/learn/arena.hpp"

using namespace diabolo;

namespace {

Arena hopping(bool free_axis) {
  return {{.tasks = {"Hop"}, .free_axis = free_axis}, {consistent_model()}, portable_batch_kernel<2>()};
}

}  // namespace

TEST_CASE("a free axle is drawn within its ranges, and what a model has itself stays") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Draw draw(seed, 0);
    AllEffects<double> effects;
    draw_free_axle(effects, draw);
    const auto within = [](double value, double low, double high) { return value >= low && value < high; };
    CHECK(within(effects.get<GyroscopicTilt>().gain, 3.0, 8.0));
    CHECK(within(effects.get<GyroscopicTilt>().inertia_ratio, 1.0, 1.4));
    CHECK(within(effects.get<Groove>().profile_radius, 0.002, 0.010));
    CHECK(within(effects.get<Groove>().half_width, 0.003, 0.008));
    AllEffects<double> own;
    own.get<StringFriction>().spin_gain = 3.7;
    own.get<Groove>().half_width = 0.02;
    draw_free_axle(own, draw);
    CHECK(own.get<GyroscopicTilt>().gain == 3.7);
    CHECK(own.get<Groove>().half_width == 0.02);
    own.get<GyroscopicTilt>().gain = 2.0;
    draw_free_axle(own, draw);
    CHECK(own.get<GyroscopicTilt>().gain == 2.0);
  }
}

TEST_CASE("a free axle changes nothing of where an episode begins, and turns in it") {
  Arena fixed = hopping(false), free = hopping(true);
  CHECK(fixed.effects_of(0).get<GyroscopicTilt>().neutral());
  double inertia = 0.0;
  for (int k = 0; k < 5; ++k) {
    fixed.reset(0), free.reset(0);
    CHECK(fixed.observations == free.observations);
    const double drawn = free.effects_of(0).get<GyroscopicTilt>().inertia_ratio;
    CHECK((drawn >= 1.0 && drawn != inertia));
    inertia = drawn;
  }
  const std::vector<float> askew{0.3F, 0.0F, 0.0F, -0.3F, 0.0F, 0.0F};
  for (int k = 0; k < 50; ++k) fixed.step(askew.data()), free.step(askew.data());
  CHECK(fixed.episode(0).state.axis == Vector3<double>::UnitX());
  CHECK((free.episode(0).state.axis - Vector3<double>::UnitX()).norm() > 1e-3);
  CHECK(free.episode(0).state.axis.norm() == Approx(1.0));
}
