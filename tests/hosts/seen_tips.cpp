// SPDX-License-Identifier: MIT
#include "diabolo/hosts/seen_tips.hpp"

#include <optional>

#include "catch.hpp"

using namespace diabolo;

namespace {

constexpr double kStep = 1e-3;
const Vector3<double> kVelocity(1.0, 2.0, -3.0), kAcceleration(4.0, 0.0, 2.0);

// A tip under constant acceleration.
Vector3<double> place_at(double t) { return kVelocity * t + kAcceleration * (0.5 * t * t); }
Vector3<double> velocity_at(double t) { return kVelocity + kAcceleration * t; }

}  // namespace

TEST_CASE("a tip that is placed rests in the first step, then has the velocities of its places") {
  std::optional<TipMemory> memory;
  const TipStep first = placed_tip(place_at(0.0), kStep, memory);
  CHECK(first.begin == first.end);
  CHECK(first.end_velocity.norm() == 0.0);
  placed_tip(place_at(kStep), kStep, memory);
  const TipStep step = placed_tip(place_at(2 * kStep), kStep, memory);
  CHECK(step.begin == place_at(kStep));
  CHECK(step.end == place_at(2 * kStep));
  CHECK((step.begin_velocity - velocity_at(kStep)).norm() < 1e-12);
  CHECK((step.end_velocity - velocity_at(2 * kStep)).norm() < 1e-12);
}

TEST_CASE("a tip that moves goes on as its velocity changes") {
  std::optional<TipMemory> memory;
  const TipStep first = moving_tip(place_at(0.0), velocity_at(0.0), kStep, memory);
  CHECK(first.end_velocity == velocity_at(0.0));
  const TipStep step = moving_tip(place_at(kStep), velocity_at(kStep), kStep, memory);
  CHECK(step.begin == place_at(kStep));
  CHECK((step.end_velocity - velocity_at(2 * kStep)).norm() < 1e-12);
  CHECK((step.end - place_at(2 * kStep)).norm() < kAcceleration.norm() * kStep * kStep);
}

TEST_CASE("both tips of a step know their sticks and the time") {
  TipStep left, right;
  left = {place_at(0.0), place_at(1.0), velocity_at(0.0), velocity_at(1.0), Vector3<double>::UnitX()};
  right = left;
  right.direction = Vector3<double>::UnitY();
  const auto [begin, end] = tips_of_step(left, right, 7.0, kStep);
  CHECK(begin.time == 7.0);
  CHECK(end.time == 7.0 + kStep);
  CHECK(end.left == place_at(1.0));
  CHECK(end.right_velocity == velocity_at(1.0));
  CHECK(begin.left_direction == Vector3<double>::UnitX());
  CHECK(end.right_direction == Vector3<double>::UnitY());
}
