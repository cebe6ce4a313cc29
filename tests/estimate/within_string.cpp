// SPDX-License-Identifier: MIT
#include "diabolo/estimate/within_string.hpp"

#include "catch.hpp"
#include "diabolo/effects/finite_axle.hpp"
#include "diabolo/string/hanging.hpp"
#include "random.hpp"

using namespace diabolo;

namespace {

Tips<double> moving_tips(Random& random) {
  Tips<double> tips;
  tips.left = {0.0, random.uniform(0.1, 0.5), 1.0};
  tips.right = {0.0, -random.uniform(0.1, 0.5), 1.1};
  tips.left_velocity = random.vector(1.0);
  tips.right_velocity = random.vector(1.0);
  return tips;
}

}  // namespace

TEST_CASE("a state near a string that pulls comes onto it, and moves along it") {
  const unsigned seed = 91;
  CAPTURE(seed);
  Random random(seed);
  EffectSet<double, FiniteAxle> effects;
  effects.get<FiniteAxle>().radius = 0.007;
  const Predictor<double, FiniteAxle> thick(Parameters<double>::consistent(), effects);
  const Predictor<double> thin(Parameters<double>::consistent());
  const auto check = [&](const auto& predictor) {
    const Tips<double> tips = moving_tips(random);
    State<double> state = hanging_state(tips.left, tips.right, predictor.parameters().string_length);
    state.position += random.vector(0.02);
    state.velocity = random.vector(1.0);
    keep_within_string(predictor, state, tips, true);
    const TightString string = TightString::around(predictor, state, tips);
    CHECK(std::abs(string.excess()) < 1e-6);  // what Newton's method leaves of centimetres
    CHECK(std::abs(string.path.rate(state.velocity, tips.left_velocity, tips.right_velocity)) < 1e-4);
  };
  for (int trial = 0; trial < 50; ++trial) {
    check(thin);
    check(thick);
  }
}

TEST_CASE("a state within a slack string, or off it, stays as it is") {
  const Predictor<double> predictor(Parameters<double>::consistent());
  const unsigned seed = 92;
  CAPTURE(seed);
  Random random(seed);
  const Tips<double> tips = moving_tips(random);
  State<double> state = hanging_state(tips.left, tips.right, predictor.parameters().string_length);
  state.velocity = {0.1, 0.2, -0.3};
  state.position.z() += 0.1;
  State<double> inside = state;
  keep_within_string(predictor, inside, tips, false);
  CHECK(inside.position == state.position);
  CHECK(inside.velocity == state.velocity);
  state.position.z() -= 0.3;
  state.string_state = StringState::kFlying;
  State<double> off = state;
  keep_within_string(predictor, off, tips, true);
  CHECK(off.position == state.position);
}
