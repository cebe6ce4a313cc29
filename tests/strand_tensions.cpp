// SPDX-License-Identifier: MIT
#include "diabolo/strand_tensions.hpp"

#include <cmath>

#include "catch.hpp"
#include "diabolo/effects/finite_axle.hpp"
#include "diabolo/effects/string_friction.hpp"
#include "diabolo/string/hanging.hpp"
#include "smooth_tips.hpp"

using namespace diabolo;

namespace {

constexpr double kMillisecond = 1e-3;

/// Tensions over the next step.
template <template <class> class... Effects>
std::pair<double, double> tensions_ahead(const Predictor<double, Effects...>& predictor, State<double>& state,
                                         const SmoothTips& tips, double t, double dt = kMillisecond) {
  const State<double> before = state;
  const Tips<double> begin = tips.at(t), end = tips.at(t + dt);
  predictor.step(state, begin, end, dt);
  return strand_tensions(predictor, before, state, begin, end, dt);
}

SmoothTips still(double apart) {
  SmoothTips tips;
  tips.left.center = {0.0, 0.5 * apart, 1.0};
  tips.right.center = {0.0, -0.5 * apart, 1.0};
  return tips;
}

}  // namespace

TEST_CASE("two strands carry the weight of a diabolo that hangs") {
  const Parameters<double> parameters = Parameters<double>::consistent();
  const Predictor<double> predictor(parameters);
  for (const double apart : {0.0, 0.1, 0.6, 1.2}) {
    const SmoothTips tips = still(apart);
    State<double> state = hanging_state(tips.at(0.0).left, tips.at(0.0).right, parameters.string_length);
    const auto [left, right] = tensions_ahead(predictor, state, tips, 0.0);
    const double down = std::sqrt(1.0 - std::pow(apart / parameters.string_length, 2));  // of a strand
    CHECK(left == Approx(0.5 * parameters.mass * kStandardGravity / down).epsilon(1e-6));
    CHECK(right == Approx(left).epsilon(1e-6));
  }
}

TEST_CASE("tensions are those of the constraint, however the tips move") {
  const Parameters<double> parameters = Parameters<double>::consistent();
  const Predictor<double> predictor(parameters);
  const unsigned seed = 2611;
  CAPTURE(seed);
  Random random(seed);
  int taut = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const SmoothTips tips = SmoothTips::random(random, 0.5, 0.06, 5.0);
    TautReference reference;
    reference.tips = tips;
    reference.position =
        hanging_state(tips.at(0.0).left, tips.at(0.0).right, parameters.string_length).position;
    reference.velocity = random.vector(0.3);
    reference.make_consistent();
    State<double> state;
    state.position = reference.position;
    state.velocity = reference.velocity;
    state.string_state = StringState::kOnString;
    for (int i = 0; i < 300; ++i) {
      const auto [left, right] = tensions_ahead(predictor, state, tips, i * kMillisecond);
      reference.advance((i + 0.5) * kMillisecond, 1e-4);
      const double expected = parameters.mass * reference.tension();
      if (i > 5 && expected > 0.5) {
        CHECK(left == Approx(expected).epsilon(0.01));
        CHECK(right == Approx(expected).epsilon(0.01));
        ++taut;
      }
      reference.advance((i + 1) * kMillisecond, 1e-4);
    }
  }
  CHECK(taut > 3000);
}

TEST_CASE("a string that slips has tensions as exp(c b)") {
  Parameters<double> parameters = Parameters<double>::consistent();
  EffectSet<double, StringFriction> effects;
  effects.get<StringFriction>().coefficient = 0.2;
  const Predictor<double, StringFriction> predictor(parameters, effects);
  const SmoothTips tips = still(0.7);
  for (const double spin : {-80.0, 80.0}) {
    State<double> state =
        hanging_state(tips.at(0.0).left, tips.at(0.0).right, parameters.string_length, spin);
    for (int i = 0; i < 200; ++i) {
      const State<double> before = state;
      const auto [left, right] = tensions_ahead(predictor, state, tips, i * kMillisecond);
      const Strands<double> strands = Strands<double>::halfway(before, state, tips.at(0.0), tips.at(0.0));
      const double around = M_PI - std::acos(strands.left.dot(strands.right));
      CHECK(std::abs(std::log(right / left)) == Approx(0.2 * around).epsilon(0.01));
      CHECK((spin > 0.0) == (right < left));
    }
  }
}

TEST_CASE("the tips are pulled along their strands, and carry what the diabolo does not fall by") {
  Parameters<double> parameters = Parameters<double>::consistent();
  EffectSet<double, FiniteAxle> effects;
  effects.get<FiniteAxle>().radius = GENERATE(0.0, 0.01);
  const Predictor<double, FiniteAxle> predictor(parameters, effects);
  const unsigned seed = 2612;
  CAPTURE(seed, effects.get<FiniteAxle>().radius);
  Random random(seed);
  const SmoothTips tips = SmoothTips::random(random, 0.5, 0.05, 4.0);
  State<double> state = hanging_state(tips.at(0.0).left, tips.at(0.0).right, parameters.string_length);
  for (int i = 0; i < 300; ++i) {
    const State<double> before = state;
    const Tips<double> begin = tips.at(i * kMillisecond), end = tips.at((i + 1) * kMillisecond);
    predictor.step(state, begin, end, kMillisecond);
    if (state.string_state != StringState::kOnString || i < 10) continue;
    const TipForces<double> forces = tip_forces(predictor, before, state, begin, end, kMillisecond);
    const auto [left, right] = strand_tensions(predictor, before, state, begin, end, kMillisecond);
    CHECK(forces.left.norm() == Approx(left));
    CHECK(forces.right.norm() == Approx(right));
    const Vector3<double> pull = parameters.mass * string_pull(predictor, before, state, begin, kMillisecond);
    // A pull lies between the strands but for the turn of a step.
    CHECK((forces.left + forces.right + pull).norm() < 0.01 * pull.norm());
  }
}

TEST_CASE("a slack string has no tension") {
  const Predictor<double> predictor{Parameters<double>::consistent()};
  State<double> state;
  state.position = {0.0, 0.0, 1.3};
  state.string_state = StringState::kFlying;
  const auto [left, right] = tensions_ahead(predictor, state, still(0.6), 0.0);
  CHECK(left == 0.0);
  CHECK(right == 0.0);
}
