// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "support.hpp"

using namespace plant;

namespace {

/// The nominal plant and a lively beat; `rotation` turns the whole world, `mirrored` swaps left and right in
/// it.
struct Play {
  PlantParameters parameters;
  Start start;
  Motion motion;
};

double yaw_of(const Vec3& direction) { return std::atan2(direction.y(), direction.x()); }
double pitch_of(const Vec3& direction) { return std::asin(direction.z()); }

Play lively(const Eigen::Matrix3d& rotation, bool mirrored, double left_lift, double right_lift) {
  const double side = mirrored ? -1.0 : 1.0;
  const Eigen::Matrix3d world = rotation * Vec3(1.0, side, 1.0).asDiagonal();
  const auto turned = [&](Vec3 left, Vec3 right) {
    if (mirrored) std::swap(left, right);
    return Pair<Vec3>{world * left, world * right};
  };
  SticksPose pose;
  pose.tips = turned({0.01, 0.35, 1.30}, {0.0, -0.3, 1.25});
  const Pair<Vec3> directions = turned(direction_from_angles(-0.2, 0.3), direction_from_angles(0.1, 0.2));
  for (std::size_t i = 0; i < 2; ++i) {
    pose.yaws[i] = yaw_of(directions[i]);
    pose.pitches[i] = pitch_of(directions[i]);
  }
  MotionBuilder motion(pose);
  motion.oscillate(turned({0.02, 0.03, left_lift}, {-0.01, 0.02, right_lift}), 1.5, 4.0);
  const Vec3 axis = world * direction_from_angles(0.05, -0.03);
  Start start;
  start.spin = side * 120.0;
  start.yaw = yaw_of(axis);
  start.pitch = pitch_of(axis);
  PlantParameters parameters;
  parameters.gravity = world * parameters.gravity;
  return {parameters, start, motion.finish({}, 0)};
}

std::vector<Moment> play(const Play& play, int steps_per_second = 48000) {
  PlantParameters parameters = play.parameters;
  parameters.steps_per_second = steps_per_second;
  return simulate(StrandsPlant(parameters, play.motion), play.start, times_until(2.0, 40));
}

/// Largest distance between two plays after the second is turned by `back` [m], and of their axes.
double position_distance(const std::vector<Moment>& one, const std::vector<Moment>& other,
                         const Eigen::Matrix3d& back = Eigen::Matrix3d::Identity()) {
  REQUIRE(one.size() == other.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (const int column : {kPosition, kAxis}) {
      largest = std::max(largest, (one[i].state.col(column) - back * other[i].state.col(column)).norm());
    }
  }
  return largest;
}

bool slackens(const std::vector<Moment>& moments) {
  return std::any_of(moments.begin(), moments.end(), [](const Moment& m) { return m.mode == Mode::kLoose; });
}

const Eigen::Matrix3d kNone = Eigen::Matrix3d::Identity();

}  // namespace

TEST_CASE("a world turned with its gravity plays the same") {
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(0.7, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  const std::vector<Moment> plain = play(lively(kNone, false, 0.08, -0.06));
  const double distance =
      position_distance(plain, play(lively(rotation, false, 0.08, -0.06)), rotation.transpose());
  INFO("distance " << distance);
  CHECK(distance < 1e-9);
  CHECK(position_distance(plain, play(lively(rotation, false, 0.08, -0.06))) > 0.1);
}

TEST_CASE("a mirrored world with opposite spin plays mirrored") {
  const Eigen::Matrix3d mirror = Vec3(1.0, -1.0, 1.0).asDiagonal();
  const std::vector<Moment> plain = play(lively(kNone, false, 0.08, -0.06));
  const double distance = position_distance(plain, play(lively(kNone, true, 0.08, -0.06)), mirror);
  INFO("distance " << distance);
  CHECK(distance < 1e-9);
}

TEST_CASE("the error of the step falls with its fourth power where play is smooth") {
  PlantParameters parameters;
  parameters.sticks.bending_stiffness.reset();
  const StrandsPlant hands(parameters, still_hands({0.01, 0.35, 1.30}, {0.0, -0.3, 1.25}));
  Play swinging{parameters, Start{}, hands.motion()};
  swinging.start.yaw = 0.1;
  swinging.start.position = hands.begin(swinging.start).state.col(kPosition);
  swinging.start.velocity = Vec3(0.1, 0.4, 0.0);
  const std::vector<Moment> finest = play(swinging, 96000);
  REQUIRE_FALSE(slackens(finest));
  const double coarse = position_distance(play(swinging, 3000), finest);
  const double middle = position_distance(play(swinging, 6000), finest);
  const double nominal = position_distance(play(swinging, 48000), finest);
  INFO("at 3000, 6000 and 48000 steps per second: " << coarse << ", " << middle << ", " << nominal);
  CHECK(coarse / middle > 12.0);
  CHECK(coarse / middle < 20.0);
  CHECK(nominal < 1e-11);
}

TEST_CASE("the step is short enough where the string slackens and tautens") {
  const Play hopping = lively(kNone, false, 0.15, 0.14);
  const std::vector<Moment> finest = play(hopping, 96000);
  REQUIRE(slackens(finest));
  const double nominal = position_distance(play(hopping, 48000), finest);
  INFO("at 48000 steps per second: " << nominal);
  CHECK(nominal < 1e-6);
}

TEST_CASE("looking more often does not change what is seen") {
  const Play hopping = lively(kNone, false, 0.15, 0.14);
  const StrandsPlant plant(hopping.parameters, hopping.motion);
  const Moment once = simulate(plant, hopping.start, {1.0}).front();
  const Moment often = simulate(plant, hopping.start, times_until(1.0, 777)).back();
  CHECK(once.state == often.state);
}

TEST_CASE("play that begins later is the same play later") {
  const auto play_after = [](double pause) {
    MotionBuilder motion(SticksPose{});
    motion.hold(pause);
    motion.oscillate({Vec3(0.0, 0.05, 0.08), Vec3(0.0, 0.05, -0.06)}, 1.5, 3.0);
    Start start;
    start.spin = 0.0;  // so that nothing moves before the hands do
    std::vector<double> times = times_until(2.0, 40);
    for (double& time : times) time += pause;
    return simulate(StrandsPlant(PlantParameters{}, motion.finish({}, 0)), start, times);
  };
  const double distance = position_distance(play_after(0.6), play_after(1.2));
  INFO("distance " << distance);
  CHECK(distance < 1e-8);
}
