// SPDX-License-Identifier: MIT
#include "diabolo/learn/arm_hands.hpp"

#include <algorithm>
#include <vector>

#include "catch.hpp"
#include "diabolo/robot/arm/build_seed_grid.hpp"
#include "random.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

StickMap map_of(Side side) {
  const StickArm arm = paper_arm(side);
  return {arm, build_seed_grid(arm, paper_box(arm))};
}

const StickMap& left() {
  static const StickMap map = map_of(Side::kLeft);
  return map;
}
const StickMap& right() {
  static const StickMap map = map_of(Side::kRight);
  return map;
}

/// The fastest and the most accelerated joint of hands that do whatever they may, from ticks of 2 ms.
std::pair<double, double> most_of(const HandLimits& limits, unsigned seed) {
  constexpr double kPeriod = 0.02;
  constexpr int kTicks = 10;
  Random random(seed);
  Hands hands;
  hands.position = {limits.centre + Vector3<double>(0.0, 0.3, 0.0),
                    limits.centre - Vector3<double>(0.0, 0.3, 0.0)};
  std::vector<PairJoints> ticks;
  double wanted[6]{};
  for (int period = 0; period < 2000; ++period) {
    for (double& share : wanted)
      if (random.chance(0.1)) share = random.chance(0.5) ? 1.0 : -1.0;
    const Hands begun = hands;
    move_hands(hands, wanted, limits, 1.45, kPeriod);
    for (int k = 0; k < kTicks; ++k) {
      const Tips<double> tips = tips_between(begun, hands, static_cast<double>(k) / kTicks, kPeriod);
      PairJoints joints;
      joints << left().at(tips.left).joints, right().at(tips.right).joints;
      ticks.push_back(joints);
    }
  }
  double speed = 0.0, acceleration = 0.0;
  for (std::size_t k = 2; k < ticks.size(); ++k) {
    const PairJoints rate = (ticks[k] - ticks[k - 1]) / kTick,
                     change = (ticks[k] - 2.0 * ticks[k - 1] + ticks[k - 2]) / (kTick * kTick);
    speed = std::max(speed, rate.cwiseAbs().maxCoeff());
    acceleration = std::max(acceleration, change.cwiseAbs().maxCoeff());
  }
  return {speed, acceleration};
}

}  // namespace

TEST_CASE(
    "whatever hands do within their limits, the joints of both arms keep theirs, and use much of them") {
  const JointLimits joints = JointLimits::uniform();
  const HandLimits limits = arm_hand_limits(left(), right(), joints);
  CHECK(limits.speed > 0.3);
  CHECK(limits.acceleration > 0.9);
  const unsigned seed = 2471;
  CAPTURE(seed);
  const auto [speed, acceleration] = most_of(limits, seed);
  CHECK(speed <= joints.speed[0]);
  CHECK(acceleration <= joints.acceleration[0]);
  CHECK(acceleration > 0.4 * joints.acceleration[0]);
}

TEST_CASE("twice as strong arms allow twice the acceleration, slower ones less speed") {
  const HandLimits usual = arm_hand_limits(left(), right(), JointLimits::uniform());
  const HandLimits strong = arm_hand_limits(left(), right(), JointLimits::uniform(0.95 * kPi, 30.0));
  const HandLimits slow = arm_hand_limits(left(), right(), JointLimits::uniform(0.5));
  CHECK(strong.acceleration == Approx(2.0 * usual.acceleration));
  CHECK(strong.speed > usual.speed);
  CHECK(slow.speed < 0.5 * usual.speed);
  CHECK(slow.acceleration == usual.acceleration);
}

TEST_CASE("a room that an arm does not reach is refused, with the place") {
  HandLimits room = arm_room();
  room.centre.x() = 3.0;
  CHECK_THROWS_WITH(arm_hand_limits(left(), right(), JointLimits::uniform(), room),
                    Contains("the left arm at (") && Contains("outside the box"));
  CHECK_THROWS_WITH(arm_hand_limits(right(), left(), JointLimits::uniform()), Contains("the left arm, then"));
}
