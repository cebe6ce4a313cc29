// SPDX-License-Identifier: MIT
#include "diabolo/learn/follow_pointers.hpp"

#include "catch.hpp"
#include "diabolo/plan/limits.hpp"

using namespace diabolo;

TEST_CASE("hands come to rest at the pointers, within a person's limits, and never tear the string") {
  constexpr double kLength = 1.45, kStep = 1e-3;
  CHECK(kFastestHand == TipLimits().speed);
  CHECK(kHardestHand == TipLimits().acceleration);
  Hands hands;
  hands.position = {Vector3<double>(0.0, 0.4, 1.25), Vector3<double>(0.0, -0.4, 1.25)};
  const Hands::Pair near{Vector3<double>(0.0, 0.6, 1.5), Vector3<double>(0.0, -0.2, 1.0)},
      apart{Vector3<double>(0.0, 1.2, 2.2), Vector3<double>(0.0, -1.2, 0.5)};
  for (int i = 0; i < 1000; ++i) {
    const Hands before = hands;
    follow_pointers(hands, near, kLength, kStep);
    for (std::size_t side = 0; side < 2; ++side) {
      CHECK(hands.velocity[side].norm() <= kFastestHand);
      CHECK((hands.velocity[side] - before.velocity[side]).norm() <=
            TipLimits().acceleration * kStep * 1.001);
      CHECK((hands.position[side] - before.position[side] - hands.velocity[side] * kStep).norm() < 1e-15);
    }
  }
  for (std::size_t side = 0; side < 2; ++side) CHECK((hands.position[side] - near[side]).norm() < 1e-6);
  for (int i = 0; i < 1000; ++i) {
    follow_pointers(hands, apart, kLength, kStep);
    CHECK((hands.position[0] - hands.position[1]).norm() <= kLength);
  }
}
