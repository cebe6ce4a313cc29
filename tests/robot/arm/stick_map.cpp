// SPDX-License-Identifier: MIT
#include "diabolo/robot/arm/stick_map.hpp"

#include <limits>

#include "catch.hpp"
#include "count_allocations.hpp"
#include "diabolo/robot/arm/build_seed_grid.hpp"
#include "diabolo/robot/motion/tip_speed.hpp"
#include "robot/support.hpp"

using namespace diabolo;

namespace {

/// The nominal arms of both sides and a calibrated one.
std::vector<StickMap> maps() {
  std::vector<StickMap> all;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const StickArm arm = paper_arm(side);
    all.emplace_back(arm, build_seed_grid(arm, paper_box(arm)));
  }
  Random random(61);
  StickArm arm = paper_arm(Side::kRight);
  arm.chain = ur5e_from_calibration<double>(random_calibration(random));
  all.emplace_back(arm, build_seed_grid(arm, paper_box(arm)));
  return all;
}

/// A closed way through the box, `t` from 0 to 1: loop 0 a circle, 1 a figure of eight, 2 an upright eight, 3
/// a long oval, 4 a knot of three lobes.
Vector3<double> loop(int number, double t, const GridBox& box) {
  const double a = 2 * M_PI * t;
  const Vector3<double> middle = 0.5 * (box.lower + box.upper), half = 0.45 * (box.upper - box.lower);
  Vector3<double> at;
  switch (number) {
    case 0:
      at = {std::cos(a), std::sin(a), 0};
      break;
    case 1:
      at = {std::sin(2 * a), std::sin(a), 0.3 * std::cos(a)};
      break;
    case 2:
      at = {0.2 * std::cos(a), std::sin(2 * a), std::sin(a)};
      break;
    case 3:
      at = {0.7 * std::cos(a), 0.3 * std::sin(a), std::cos(a)};
      break;
    default:
      at = {std::cos(3 * a) * std::cos(a), std::cos(3 * a) * std::sin(a), std::sin(2 * a)};
  }
  return middle + Vector3<double>(half.cwiseProduct(at));
}

}  // namespace

TEST_CASE("every point of the box is reached, within the ranges") {
  Random random(62);
  for (const StickMap& map : maps()) {
    const GridBox& box = map.grid().box();
    const bool right = map.arm().side == Side::kRight;
    for (int i = 0; i < 10000; ++i) {
      const Vector3<double> p = i < 8 ? Vector3<double>(i & 1 ? box.lower.x() : box.upper.x(),
                                                        i & 2 ? box.lower.y() : box.upper.y(),
                                                        i & 4 ? box.lower.z() : box.upper.z())
                                      : random_point(random, box);
      const StickMap::Point point = map.at(p);
      REQUIRE(point.fault == StickFault::kNone);
      REQUIRE((map.arm().tip_at(point.joints) - p).norm() <= 1e-9);
      REQUIRE(map.arm().ranges.contain(point.joints));
      REQUIRE((right ? -point.joints[2] : point.joints[2]) > 0.3);  // the elbow never turns over
    }
  }
}

TEST_CASE("a point outside the box, or none, has no joints") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const StickMap& map : maps()) {
    const Vector3<double> middle = 0.5 * (map.grid().box().lower + map.grid().box().upper);
    for (int axis = 0; axis < 3; ++axis) {
      Vector3<double> p = middle;
      p[axis] = map.grid().box().upper[axis] + 1e-9;
      CHECK(map.at(p).fault == StickFault::kOutside);
      p[axis] = nan;
      CHECK(map.at(p).fault == StickFault::kOutside);
    }
    CHECK(map.at(middle).fault == StickFault::kNone);
  }
  // A grid that promises what the arm cannot reach, and ranges that are too narrow.
  StickArm far = paper_arm(Side::kRight);
  const IkSeedGrid grid = build_seed_grid(far, paper_box(far));
  const Vector3<double> p = grid.box().upper;
  far.base.position.x() -= 0.5;
  CHECK(StickMap(far, grid).at(p).fault == StickFault::kOutOfReach);
  StickArm narrow = paper_arm(Side::kRight);
  narrow.ranges.upper[4] = 3.0;
  CHECK(StickMap(narrow, grid).at(p).fault == StickFault::kRange);
}

TEST_CASE("the map's slopes are its derivative") {
  Random random(63);
  for (const StickMap& map : maps())
    for (int i = 0; i < 300; ++i) {
      Vector3<double> p = random_point(random, map.grid().box());
      p = 0.99 * p + 0.01 * 0.5 * (map.grid().box().lower + map.grid().box().upper);
      const double h = 1e-5;
      for (int axis = 0; axis < 3; ++axis) {
        Vector3<double> up = p, down = p;
        up[axis] += h;
        down[axis] -= h;
        const Joints<double> slope = (map.at(up).joints - map.at(down).joints) / (2 * h);
        REQUIRE((map.at(p).slopes.col(axis) - slope).cwiseAbs().maxCoeff() <= 1e-5);
      }
    }
}

TEST_CASE("no joint races or jumps anywhere in the box") {
  Random random(64);
  for (const StickMap& map : maps()) {
    double steepest = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vector3<double> p = random_point(random, map.grid().box());
      const StickMap::Point point = map.at(p);
      REQUIRE(point.fault == StickFault::kNone);
      steepest = std::max(steepest, point.slopes.rowwise().norm().maxCoeff());
      const Vector3<double> q = p + 1e-3 * random.direction();
      const StickMap::Point next = map.at(q);
      if (next.fault == StickFault::kOutside) continue;
      REQUIRE((next.joints - point.joints).cwiseAbs().maxCoeff() <= 0.01);
    }
    CHECK(steepest <= 10);  // [rad/m]
  }
}

TEST_CASE("the joints' slopes are continuous from cell to cell") {
  Random random(65);
  for (const StickMap& map : maps()) {
    const GridBox& box = map.grid().box();
    for (int i = 0; i < 500; ++i) {
      Vector3<double> p = random_point(random, box);
      const int axis = random.index(3);
      p[axis] = box.lower[axis] + (1 + random.index(4)) * box.spacing(axis);
      Vector3<double> before = p, after = p;
      before[axis] -= 1e-10;
      after[axis] += 1e-10;
      REQUIRE((map.at(after).joints - map.at(before).joints).cwiseAbs().maxCoeff() <= 1e-8);
      REQUIRE((map.at(after).slopes - map.at(before).slopes).cwiseAbs().maxCoeff() <= 1e-6);
    }
  }
}

TEST_CASE("loops leave no drift behind, where following the pseudo-inverse does") {
  constexpr int kCycles = 1000, kSteps = 40, kFine = 2000;
  for (const StickMap& map : maps()) {
    double drift = 0;  // of the pseudo-inverse, after a single cycle
    for (int number = 0; number < 5; ++number) {
      const GridBox& box = map.grid().box();
      const Vector3<double> start = loop(number, 0, box);
      const Joints<double> begin = map.at(start).joints;
      Joints<double> end = begin;
      for (int cycle = 0; cycle < kCycles; ++cycle)
        for (int i = 1; i <= kSteps; ++i) end = map.at(loop(number, i % kSteps * (1.0 / kSteps), box)).joints;
      REQUIRE((end - begin).cwiseAbs().maxCoeff() <= 1e-10);
      // The same point by another way.
      map.at(box.upper);
      REQUIRE((map.at(start).joints - begin).cwiseAbs().maxCoeff() <= 1e-10);

      Joints<double> q = begin;
      for (int i = 1; i <= kFine; ++i) {
        const Vector3<double> target = map.arm().to_base(loop(number, static_cast<double>(i) / kFine, box));
        const Vector3<double> gap = target - map.arm().chain.forward(q) * map.arm().tip;
        const PointJacobian<double> slopes = map.arm().chain.point_jacobian(q, map.arm().tip);
        q += slopes.transpose() * (slopes * slopes.transpose()).inverse() * gap;
      }
      drift = std::max(drift, (q - begin).cwiseAbs().maxCoeff());
    }
    CHECK(drift > 0.05);
  }
}

TEST_CASE("the level stick, a singular pose of the full arm, is passed at speed") {
  for (const StickMap& map : maps()) {
    const double level = map.arm().level;
    Vector3<double> p = 0.5 * (map.grid().box().lower + map.grid().box().upper);
    Joints<double> last = Joints<double>::Zero();
    bool crossed = false;
    for (int i = -500; i <= 500; ++i) {  // 1 m/s at 500 Hz
      p.z() = std::clamp(level + i * 1e-3, map.grid().box().lower.z(), map.grid().box().upper.z());
      const StickMap::Point point = map.at(p);
      REQUIRE(point.fault == StickFault::kNone);
      REQUIRE(std::abs(point.joints[5]) <= 1e-3);
      REQUIRE(point.joints.allFinite());
      if (i > -500) {
        REQUIRE((point.joints - last).cwiseAbs().maxCoeff() <= 0.01);
        crossed |= (last[4] - M_PI) * (point.joints[4] - M_PI) <= 0;
      }
      last = point.joints;
    }
    CHECK(crossed);
  }
}

TEST_CASE("the speed that is promised in a direction takes one joint to its limit") {
  Random random(66);
  for (const StickMap& map : maps()) {
    for (int i = 0; i < 500; ++i) {
      const StickMap::Slopes slopes = map.at(random_point(random, map.grid().box())).slopes;
      const Vector3<double> direction = random.direction();
      const double speed = tip_speed(slopes, direction);
      const Joints<double> rates = slopes * Vector3<double>(direction * speed);
      REQUIRE(rates.cwiseAbs().maxCoeff() == Approx(kUr5eJointSpeed));
      REQUIRE(tip_speed(slopes, Vector3<double>(direction * 3.0)) == Approx(speed));
      REQUIRE(slowest_tip_speed(slopes) <= speed * (1 + 1e-12));
    }
  }
}

TEST_CASE("looking up takes no memory") {
  const StickMap map = maps().front();
  Random random(67);
  const long before = allocations;
  double sum = 0;
  for (int i = 0; i < 100; ++i) sum += map.at(random_point(random, map.grid().box())).joints[0];
  CHECK(allocations == before);
  CHECK(sum > 0);
}

TEST_CASE("a box beyond reach is refused with the point") {
  const StickArm arm = paper_arm(Side::kLeft);
  GridBox box = paper_box(arm);
  box.upper.x() += 0.6;
  std::string message;
  try {
    build_seed_grid(arm, box);
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  CHECK(message.starts_with("grid of the left arm: ("));
}
