// SPDX-License-Identifier: MIT
#include "diabolo/plan/level_hands.hpp"

#include <numbers>

#include "catch.hpp"
#include "plan/level_scene.hpp"

using namespace diabolo;
using namespace level_scene;

namespace {

constexpr double kLevelDegrees = 180.0 / std::numbers::pi;

/// What came of levelling for a while, with a look at the axle each 10 ms.
struct Levelled {
  State<double> end;
  double heading = 0.0, fastest = 0.0, hardest = 0.0;  ///< [rad], of the left hand [m/s], [m/s^2]

  double tilt() const { return std::abs(axle_angles(end.axis).tilt) * kLevelDegrees; }
  double yaw() const { return std::abs(axle_angles(end.axis).yaw - heading) * kLevelDegrees; }
};

Levelled levelled(const FullPredictor<double>& model, const AxleAngles& begin, double spin, double duration) {
  Levelled result;
  LevelHands hands(model, home(), spin);
  State<double> state = resting(model, home(), begin, spin);
  Tips<double> now = hands.tips(home());
  for (int i = 0; i < static_cast<int>(1000 * duration); ++i) {
    if (i % 10 == 0) hands.see(state.axis, state.spin);
    hands.advance(1e-3);
    const Tips<double> next = hands.tips(home());
    model.step(state, now, next, 1e-3);
    result.fastest = std::max(result.fastest, next.left_velocity.norm());
    result.hardest = std::max(result.hardest, (next.left_velocity - now.left_velocity).norm() / 1e-3);
    now = next;
  }
  result.end = state;
  result.heading = hands.turned().heading;
  return result;
}

}  // namespace

TEST_CASE("hands take a tilt of twenty degrees back within three seconds, and keep the axle level") {
  for (const double spin : {60.0, -60.0})
    for (const double profile : {0.0, 0.004, 0.01})
      for (const double tilt : {20.0, -20.0}) {
        CAPTURE(spin, profile, tilt);
        const Levelled soon = levelled(body(profile), {tilt / kLevelDegrees, 0.0}, spin, 3.0),
                       later = levelled(body(profile), {tilt / kLevelDegrees, 0.0}, spin, 20.0);
        CHECK(soon.tilt() < 5.0);
        CHECK(later.tilt() < 1.0);
        CHECK(later.yaw() < 2.0);
        CHECK(soon.fastest < 2.3);
        CHECK(soon.hardest < 34.6);
      }
}

TEST_CASE("without hands that level it an axle in a groove falls over") {
  const State<double> start = resting(body(0.006), home(), {5.0 / kLevelDegrees, 0.0}, 60.0);
  CHECK(std::abs(axle_angles(held(body(0.006), start, home(), 10.0).axis).yaw) * kLevelDegrees > 20.0);
  CHECK(levelled(body(0.006), {5.0 / kLevelDegrees, 0.0}, 60.0, 10.0).yaw() < 3.0);
}

TEST_CASE("hands turn with a diabolo that has yawed") {
  const Levelled result = levelled(body(0.0), {0.0, 25.0 / kLevelDegrees}, 100.0, 4.0);
  CHECK(result.heading * kLevelDegrees == Approx(25.0).margin(2.0));
  CHECK(result.tilt() < 1.0);
}

TEST_CASE("the velocities of the hands are the rates of their places") {
  LevelHands hands(body(0.004), home(), 80.0);
  hands.see(axle_at({0.2, -0.3}), 80.0);
  Tips<double> base = home();
  const Eigen::Vector3d moves(0.1, -0.3, 0.2);
  for (int i = 0; i < 300; ++i) hands.advance(1e-3);
  const auto at = [&](double t) {
    LevelHands then = hands;
    then.advance(t);
    Tips<double> moved = base;
    moved.left += moves * t;
    moved.left_velocity = moves;
    return then.tips(moved);
  };
  const Eigen::Vector3d left = (at(2e-5).left - at(0.0).left) / 2e-5,
                        right = (at(2e-5).right - at(0.0).right) / 2e-5;
  CHECK((left - at(1e-5).left_velocity).norm() < 1e-4);
  CHECK((right - at(1e-5).right_velocity).norm() < 1e-4);
  CHECK(right.norm() > 0.05);
}

TEST_CASE("hands follow an axle that yaws past half a turn") {
  LevelHands hands(body(0.0), home(), 80.0);
  double yaw = 0.0;
  for (int i = 0; i < 4000; ++i) {
    yaw += 1e-3;
    if (i % 10 == 0) hands.see(axle_at({0.0, yaw}), 80.0);
    hands.advance(1e-3);
  }
  CHECK(yaw > std::numbers::pi);
  CHECK(hands.turned().heading == Approx(yaw).margin(0.3));
  CHECK_THROWS_WITH(LevelHands(body(0.0), home(), 80.0, {}, {-0.1}), Catch::Contains("lead: -0.1 rad"));
}

TEST_CASE("hands keep their last gains where the diabolo is too slow to steer") {
  LevelHands hands(body(0.0), home(), 40.0);
  const auto before = hands.gains();
  hands.see(axle_at({0.1, 0.0}), 4.0);
  CHECK(hands.gains() == before);
}

TEST_CASE("hands take no lead from a throw to its catch, turn on, and lead again after it") {
  LevelHands hands(body(0.006), home(), 80.0);
  const auto lead_after = [&](StringState string) {
    hands.see(axle_at({0.3, 0.2}), 80.0, string);
    for (int i = 0; i < 1000; ++i) hands.advance(1e-3);
    return std::abs(hands.turned().lead);
  };
  CHECK(lead_after(StringState::kOnString) > 0.5);
  const double heading = hands.turned().heading;
  // Critically damped: after ten times its time constant (1 + 10) exp(-10) of the lead is left.
  CHECK(lead_after(StringState::kFlying) < 1e-3);
  CHECK(std::abs(hands.turned().heading - heading) > 0.1);
  CHECK(lead_after(StringState::kLoose) < 1e-3);
  CHECK(lead_after(StringState::kOnString) > 0.5);
  CHECK(lead_after(StringState::kLoose) > 0.5);  // in the hands, where it pulls again at once
}
