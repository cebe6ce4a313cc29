// SPDX-License-Identifier: MIT
#include "diabolo/evaluate/start_on_spring.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "diabolo/full_predictor.hpp"
#include "diabolo/rollout.hpp"

using namespace diabolo;

namespace {

using Vector = Vector3<double>;

constexpr double kDt = 1e-3;

FullPredictor<double> with_give(double string, double sticks) {
  AllEffects<double> effects;
  effects.get<StringElasticity>().compliance_per_newton = string;
  effects.get<StickFlex>().compliance = sticks;
  Parameters<double> parameters;
  parameters.mass = 0.2;
  return FullPredictor<double>(parameters, effects);
}

Tips<double> still() {
  Tips<double> tips;
  tips.left = Vector(0.0, 0.3, 1.0);
  tips.right = Vector(0.0, -0.3, 1.0);
  return tips;
}

/// As a camera sees a diabolo that hangs on a string of 1.45 m: too high or too low.
State<double> seen(double above) {
  State<double> state;
  state.position = Vector(0.0, 0.0, 1.0 - std::sqrt(0.725 * 0.725 - 0.3 * 0.3) + above);
  state.string_state = StringState::kOnString;
  state.spin = 90.0;
  return state;
}

/// In a third of a second: of the steps those with a taut string, and how far it moves up or down [m].
std::pair<double, double> hangs(const FullPredictor<double>& predictor, const State<double>& start) {
  const TipMotion<double> motion({0.0, 1.0}, {still().left, still().left}, {still().right, still().right},
                                 Interpolation::kLinear);
  double taut = 0.0, lowest = start.position.z(), highest = lowest;
  rollout(predictor, start, motion, {0.0, kDt, 300},
          [&](std::size_t, double, const auto& state, const auto&) {
            taut += state.string_state == StringState::kOnString && state.string_acceleration.norm() > 0.0;
            lowest = std::min(lowest, state.position.z());
            highest = std::max(highest, state.position.z());
          });
  return {taut / 300.0, highest - lowest};
}

}  // namespace

TEST_CASE("on a stiff spring a start off by the camera's noise rings, and one at rest on it hangs still") {
  for (const auto& [string, sticks] : {std::pair(1e-4, 0.0), {0.0, 5e-5}, {1e-3, 0.0}}) {
    const FullPredictor<double> predictor = with_give(string, sticks);
    for (const double noise : {-3e-3, 3e-3}) {
      State<double> start = seen(noise);
      CAPTURE(string, sticks, noise);
      CHECK(hangs(predictor, start).second > 2e-3);
      StartsOnSpring(predictor).place(start, predictor, still(), still(), kDt);
      CHECK((start.position - seen(0.0).position).norm() < 2e-3 + 3.0 * 2.0 * (string + 2.0 * sticks));
      const auto [taut, moves] = hangs(predictor, start);
      CHECK(taut == 1.0);
      CHECK(moves < 2e-5);
    }
  }
}

TEST_CASE("a start stays where it is seen on a rigid string, on a soft spring and off the string") {
  const State<double> as_seen = seen(4e-4);
  const auto placed = [&](const FullPredictor<double>& predictor, State<double> state) {
    StartsOnSpring(predictor).place(state, predictor, still(), still(), kDt);
    return state.position;
  };
  CHECK(placed(with_give(0.0, 0.0), as_seen) == as_seen.position);
  CHECK(placed(with_give(kBouncyString, 0.0), as_seen) == as_seen.position);
  State<double> flying = as_seen;
  flying.string_state = StringState::kFlying;
  CHECK(placed(with_give(1e-4, 0.0), flying) == as_seen.position);
}
