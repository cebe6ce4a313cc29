// SPDX-License-Identifier: MIT
#include "diabolo/hosts/seen_tips.hpp"

#include <optional>

#include "catch.hpp"

using namespace diabolo;

namespace {

constexpr double kDt = 1e-3;
const Vector3<double> kVelocity(1.0, 2.0, -3.0), kAcceleration(4.0, 0.0, 2.0);

// A tip under constant acceleration.
Vector3<double> place_at(double t) { return kVelocity * t + kAcceleration * (0.5 * t * t); }
Vector3<double> velocity_at(double t) { return kVelocity + kAcceleration * t; }

}  // namespace

TEST_CASE("a tip that is placed rests in the first step, then has the velocities of its places") {
  std::optional<TipMemory> memory;
  const TipStep first = placed_tip(place_at(0.0), kDt, memory);
  CHECK(first.begin == first.end);
  CHECK(first.end_velocity.norm() == 0.0);
  placed_tip(place_at(kDt), kDt, memory);
  const TipStep step = placed_tip(place_at(2 * kDt), kDt, memory);
  CHECK(step.begin == place_at(kDt));
  CHECK(step.end == place_at(2 * kDt));
  CHECK((step.begin_velocity - velocity_at(kDt)).norm() < 1e-12);
  CHECK((step.end_velocity - velocity_at(2 * kDt)).norm() < 1e-12);
}

TEST_CASE("a tip that moves goes on as its velocity changes") {
  std::optional<TipMemory> memory;
  const TipStep first = moving_tip(place_at(0.0), velocity_at(0.0), kDt, memory);
  CHECK(first.end_velocity == velocity_at(0.0));
  const TipStep step = moving_tip(place_at(kDt), velocity_at(kDt), kDt, memory);
  CHECK(step.begin == place_at(kDt));
  CHECK((step.end_velocity - velocity_at(2 * kDt)).norm() < 1e-12);
  CHECK((step.end - place_at(2 * kDt)).norm() < kAcceleration.norm() * kDt * kDt);
}

TEST_CASE("both tips of a step know their sticks and the time") {
  TipStep left, right;
  left = {place_at(0.0), place_at(1.0), velocity_at(0.0), velocity_at(1.0), Vector3<double>::UnitX()};
  right = left;
  right.direction = Vector3<double>::UnitY();
  const auto [begin, end] = tips_of_step(left, right, 7.0, kDt);
  CHECK(begin.time == 7.0);
  CHECK(end.time == 7.0 + kDt);
  CHECK(end.left == place_at(1.0));
  CHECK(end.right_velocity == velocity_at(1.0));
  CHECK(begin.left_direction == Vector3<double>::UnitX());
  CHECK(end.right_direction == Vector3<double>::UnitY());
}
