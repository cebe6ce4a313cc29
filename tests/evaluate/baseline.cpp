// SPDX-License-Identifier: MIT
#include "diabolo/evaluate/baseline.hpp"

#include "catch.hpp"
#include "diabolo/string/spheroid.hpp"
#include "recording/played.hpp"
#include "recording/support.hpp"

using namespace diabolo;

TEST_CASE("The lowest point is on the string, and every other point of the string is higher") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  Random random(seed);
  for (int k = 0; k < 2000; ++k) {
    const double length = random.uniform(0.5, 2.0);
    const Eigen::Vector3d left = random.vector(1.0);
    const Eigen::Vector3d right =
        left + Eigen::Vector3d(random.direction() * (length * random.uniform(0.0, 0.999)));
    const Eigen::Vector3d lowest = lowest_point(left, right, length);
    const Spheroid<double> spheroid(left, right, length);
    REQUIRE(spheroid.path_length(lowest) == Approx(length).epsilon(1e-7));
    for (int other = 0; other < 10; ++other) REQUIRE(random.reachable(spheroid).z() >= lowest.z() - 1e-9);
  }
}

TEST_CASE("Tips at one place, level tips and tips above each other have the lowest point that is plain") {
  const Eigen::Vector3d here(0.3, -0.2, 1.0), level(0.3, 0.4, 1.0), above(0.3, -0.2, 1.6);
  CHECK((lowest_point(here, here, 1.4) - Eigen::Vector3d(0.3, -0.2, 0.3)).norm() < 1e-15);
  CHECK((lowest_point(here, level, 1.0) - Eigen::Vector3d(0.3, 0.1, 0.6)).norm() < 1e-15);
  CHECK((lowest_point(here, above, 1.0) - Eigen::Vector3d(0.3, -0.2, 0.8)).norm() < 1e-15);
}

TEST_CASE("Tips farther apart than the string leave a segment: its lower end, or its middle where level") {
  const Eigen::Vector3d left(0.0, 0.8, 1.0), right(0.0, -0.8, 1.0), lower(0.0, -0.8, 0.9);
  CHECK((lowest_point(left, right, 1.45) - Eigen::Vector3d(0.0, 0.0, 1.0)).norm() < 1e-15);
  const Eigen::Vector3d axis = (left - lower).normalized();
  CHECK((lowest_point(left, lower, 1.45) - (0.5 * (left + lower) - 0.725 * axis)).norm() < 1e-15);
}

TEST_CASE("Missing tips stay where they were seen last; before that there is no baseline") {
  Recording recording = test::with_tips(4, test::beating_tips(1, 0.0));
  recording.left.valid[0] = recording.right.valid[2] = false;
  recording.left.position.col(0).setConstant(kNaN);
  recording.right.position.col(2).setConstant(kNaN);
  const Track baseline = baseline_track(recording);
  CHECK(!baseline.valid[0]);
  CHECK(baseline.valid.tail(3).all());
  CHECK(baseline.position.col(2) ==
        lowest_point(recording.left.position.col(2), recording.right.position.col(1), kBaselineStringLength));
}
