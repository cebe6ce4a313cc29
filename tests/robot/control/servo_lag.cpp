// SPDX-License-Identifier: MIT
#include "diabolo/robot/control/servo_lag.hpp"

#include "catch.hpp"
#include "robot/simulated_arm.hpp"

using namespace diabolo;

namespace {

/// A motion of all joints at a time [s], with a few frequencies.
PairJoints wave(double time) {
  PairJoints joints;
  for (int i = 0; i < 2 * kJointCount; ++i)
    joints[i] = 0.3 * std::sin((2.0 + 0.3 * i) * time) + 0.1 * std::cos((5.0 - 0.2 * i) * time + i);
  return joints;
}

}  // namespace

TEST_CASE("a motion that is only late is late by just that, parts of a tick too") {
  for (const double lag : {0.004, 0.0137, 0.034, 0.105, 0.2}) {
    std::vector<PairJoints> commanded, actual;
    for (int i = 0; i < 2000; ++i) {
      commanded.push_back(wave(i * kTick));
      actual.push_back(wave(i * kTick - lag));
    }
    const ServoLag found = estimate_lag(commanded, actual);
    CHECK(found.certain);
    CHECK(found.lag == Approx(lag).margin(2e-5).epsilon(0));
    CHECK(found.residual <= 2e-3);  // less than a tick of the fastest joint
  }
}

TEST_CASE("a servo's lag is its lookahead and what comes on top, within a tick") {
  for (const auto& [lookahead, gain] : {std::pair{0.03, 2000.0}, {0.1, 300.0}, {0.05, 500.0}})
    for (const int ticks_on_the_way : {0, 3}) {
      SimulatedArm arm(wave(0).head<kJointCount>(), gain, lookahead);
      std::vector<PairJoints> commanded, actual;
      for (int i = 0; i < 3000; ++i) {
        const double ease = std::min(1.0, i * kTick);  // no jump of speed at the start
        const auto at = [&](int tick) -> PairJoints {
          return wave(0) + ease * (wave(tick * kTick) - wave(0));
        };
        arm.servo(at(std::max(0, i - ticks_on_the_way)).head<kJointCount>());
        arm.tick();
        commanded.push_back(at(i).head<kJointCount>().replicate<2, 1>());
        actual.push_back(arm.joints().replicate<2, 1>());
      }
      const ServoLag found = estimate_lag(commanded, actual);
      CHECK(arm.trips == 0);
      CHECK(found.certain);
      CHECK(found.lag == Approx(lookahead + ticks_on_the_way * kTick).margin(kTick).epsilon(0));
    }
}

TEST_CASE("arms at rest, and a lag beyond what is looked for, are told to be uncertain") {
  const std::vector<PairJoints> still(1000, wave(0));
  CHECK_FALSE(estimate_lag(still, still).certain);
  std::vector<PairJoints> commanded, actual;
  for (int i = 0; i < 1000; ++i) {
    commanded.push_back(wave(i * kTick));
    actual.push_back(wave(i * kTick - 0.3));
  }
  CHECK_FALSE(estimate_lag(commanded, actual, 0.1).certain);
}

TEST_CASE("too little to look at is refused in a sentence") {
  const std::vector<PairJoints> few(100, wave(0)), many(1000, wave(0));
  CHECK_THROWS_WITH(estimate_lag(few, few),
                    "lag: 100 commanded and 100 actual ticks; must be as many, and 252 or more");
  CHECK_THROWS_AS(estimate_lag(many, few), std::invalid_argument);
}
