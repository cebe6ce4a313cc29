// SPDX-License-Identifier: MIT
#include "diabolo/robot/arm/clearance.hpp"

#include "catch.hpp"
#include "robot/support.hpp"

using namespace diabolo;

TEST_CASE("two capsules are as far apart as their nearest points") {
  Random random(91);
  for (int i = 0; i < 2000; ++i) {
    Capsule a{random.vector(1), random.vector(1), random.uniform(0, 0.1)};
    Capsule b{random.vector(1), random.vector(1), random.uniform(0, 0.1)};
    if (i % 5 == 0) b.to = b.from + 0.7 * (a.to - a.from);  // side by side
    if (i % 7 == 0) a.to = a.from;                          // balls
    if (i % 11 == 0) b.to = b.from;
    double nearest = 10;
    const int steps = 150;
    for (int s = 0; s <= steps; ++s)
      for (int t = 0; t <= steps; ++t) {
        const Vector3<double> p = a.from + (a.to - a.from) * (1.0 * s / steps);
        const Vector3<double> q = b.from + (b.to - b.from) * (1.0 * t / steps);
        nearest = std::min(nearest, (p - q).norm() - a.radius - b.radius);
      }
    REQUIRE(distance(a, b) <= nearest + 1e-12);
    REQUIRE(distance(a, b) >= nearest - 0.02);
    REQUIRE(distance(a, b) == Approx(distance(b, a)).margin(1e-12));
  }
  CHECK(distance({{0, 0, 0}, {0, 0, 1}, 0.1}, {{0.5, -1, 0.5}, {0.5, 1, 0.5}, 0.1}) == Approx(0.3));
}

TEST_CASE("the arm's capsules follow one another and end at the stick's tip") {
  Random random(92);
  const StickArm arm = paper_arm(Side::kLeft);
  for (int i = 0; i < 100; ++i) {
    const Joints<double> q = random_joints(random);
    const ArmShape shape = shape_of(arm, q);
    for (std::size_t k = 1; k < shape.size(); ++k) CHECK((shape[k].from - shape[k - 1].to).norm() <= 1e-15);
    CHECK((shape.back().to - arm.tip_at(q)).norm() <= 1e-15);
    CHECK((shape[2].to - shape[2].from).norm() == Approx(0.425));
    CHECK((shape[4].to - shape[4].from).norm() == Approx(0.3922));
  }
}

TEST_CASE("arms that reach for one point are found to touch with their sticks") {
  const StickArm left = paper_arm(Side::kLeft), right = paper_arm(Side::kRight);
  PairJoints apart, crossed;
  apart << 3.7, -1.64, 1.75, -1.67, M_PI, 0, 2.57, -1.51, -1.72, -1.49, M_PI, 0;
  const Clearance wide = clearance(left, right, apart);
  CHECK(wide.distance > 0.1);
  // Each arm turned inwards.
  crossed = apart;
  crossed[0] -= 1.0;
  crossed[6] += 1.0;
  const Clearance close = clearance(left, right, crossed);
  CHECK(close.distance < wide.distance);
  // Base to base it is the spacing less two radii.
  CHECK(distance(shape_of(left, apart.head<6>())[0], shape_of(right, apart.tail<6>())[0]) ==
        Approx(1.1 - 0.18));
}
