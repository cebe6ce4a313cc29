// SPDX-License-Identifier: MIT
#include "diabolo/rollout.hpp"

#include <limits>
#include <vector>

#include "catch.hpp"
#include "random.hpp"
#include "smooth_tips.hpp"

using namespace diabolo;
using Vector = Vector3<double>;
using Catch::Matchers::Contains;

namespace {

/// A player's motion, sampled.
TipMotion<double> sampled(const SmoothTips& player, double begin, double end, double interval,
                          Interpolation how) {
  std::vector<double> times;
  std::vector<Vector> left, right;
  for (double t = begin; t <= end; t += interval) {
    times.push_back(t);
    left.push_back(player.left.position(t));
    right.push_back(player.right.position(t));
  }
  return {times, left, right, how};
}

TipMotion<double> resting_tips() {
  return {{0.0}, {Vector(0.0, 0.2, 1.0)}, {Vector(0.0, -0.2, 1.0)}, Interpolation::kLinear};
}

const Predictor<double> kPredictor{Parameters<double>::consistent()};

}  // namespace

TEST_CASE("a rollout is the loop over the steps, and shows each of them") {
  Random random(600);
  const SmoothTips player = SmoothTips::random(random, 0.4, 0.2, 8.0);
  const TipMotion<double> motion = sampled(player, 0.0, 1.0, 1.0 / 120.0, Interpolation::kSpline);
  State<double> start;
  start.position = Vector(0.1, 0.0, 0.5);
  const Steps steps{0.13, 1e-3, 500};

  State<double> expected = start;
  std::size_t calls = 0;
  const State<double> last =
      rollout(kPredictor, start, motion, steps,
              [&](std::size_t i, double time, const State<double>& state, const auto&) {
                ++calls;
                CHECK(i == calls);
                CHECK(time == steps.time(i));
                kPredictor.step(expected, motion.at(steps.time(i - 1)), motion.at(time), steps.dt);
                CHECK(state.position == expected.position);
                CHECK(state.velocity == expected.velocity);
              });
  CHECK(calls == 500);
  CHECK(last.position == expected.position);
  CHECK(rollout(kPredictor, start, motion, steps).position == last.position);
  CHECK(last.spin == expected.spin);
}

TEST_CASE("two rollouts in a row are one") {
  Random random(601);
  const SmoothTips player = SmoothTips::random(random, 0.4, 0.2, 8.0);
  const TipMotion<double> motion = sampled(player, 0.0, 1.0, 0.01, Interpolation::kLinear);
  State<double> start;
  start.position = Vector(0.0, 0.1, 0.45);
  // Steps of a power of two, so that the times are the same numbers.
  const double dt = 0x1p-10;
  const State<double> whole = rollout(kPredictor, start, motion, {0.0, dt, 800});
  const State<double> half = rollout(kPredictor, start, motion, {0.0, dt, 300});
  const State<double> both = rollout(kPredictor, half, motion, {300 * dt, dt, 500});
  CHECK(both.position == whole.position);
  CHECK(both.velocity == whole.velocity);
  CHECK(both.string_state == whole.string_state);
}

TEST_CASE("no step leaves the state as it is") {
  State<double> start;
  start.position = Vector(0.0, 0.0, 0.5);
  CHECK(rollout(kPredictor, start, resting_tips(), {5.0, 1e-3, 0}).position == start.position);
}

TEST_CASE("times are counted, not summed") {
  const Steps steps{10.0, 1e-3, 1000000};
  CHECK(steps.time(0) == 10.0);
  CHECK(steps.time(1000000) == 1010.0);
  CHECK(Steps{}.dt == 1e-3);
}

TEST_CASE("steps that cannot be taken are refused") {
  const State<double> start;
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (const double dt : {0.0, -1e-3, nan, infinity}) {
    CHECK_THROWS_AS(rollout(kPredictor, start, resting_tips(), {0.0, dt, 1}), std::invalid_argument);
    CHECK_THROWS_WITH((Steps{0.0, dt, 1}.validate()), Contains("dt: ") && Contains("positive"));
  }
  CHECK_THROWS_WITH((Steps{nan, 1e-3, 1}.validate()), Contains("begin") && Contains("finite"));
  CHECK_THROWS_AS(rollout(kPredictor, start, resting_tips(), {infinity, 1e-3, 1}), std::invalid_argument);
}
