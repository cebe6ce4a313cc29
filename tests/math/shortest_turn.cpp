// SPDX-License-Identifier: MIT
#include "diabolo/math/shortest_turn.hpp"

#include <cmath>

#include "catch.hpp"
#include "random.hpp"

using namespace diabolo;

TEST_CASE("the shortest turn leads one direction onto another, by no more than the angle between them") {
  Random random(2405);
  const auto direction = [&] {
    return Eigen::Vector3d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0))
        .normalized();
  };
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d from = direction(), to = direction();
    const Eigen::Quaterniond turn = shortest_turn(from, to);
    REQUIRE((turn * from - to).norm() < 1e-9);
    const double angle = std::atan2(from.cross(to).norm(), from.dot(to));
    REQUIRE(2.0 * std::atan2(turn.vec().norm(), std::abs(turn.w())) == Approx(angle).margin(1e-9));
  }
}

TEST_CASE("the same direction is not turned, and the opposite one by half a turn") {
  const Eigen::Vector3d along = Eigen::Vector3d(0.2, -0.3, 0.8).normalized();
  CHECK(shortest_turn(along, along).vec().norm() < 1e-12);
  CHECK((shortest_turn(along, -along) * along + along).norm() < 1e-12);
}
