// SPDX-License-Identifier: MIT
#include "diabolo/learn/hands.hpp"

#include "catch.hpp"
#include "random.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

constexpr double kPeriod = 0.01, kLength = 1.45;

Hands at_home(const HandLimits& limits) {
  Hands hands;
  const Vector3<double> apart(0.0, 0.24, 0.0);
  hands.position = {limits.centre + apart, limits.centre - apart};
  return hands;
}

/// How far beyond any limit the hands are between `begin` and `end` [m, m/s or m/s^2].
double beyond(const Hands& begin, const Hands& end, const HandLimits& limits) {
  double worst = 0.0;
  for (int k = 0; k <= 20; ++k) {
    const Tips<double> tips = tips_between(begin, end, k / 20.0, kPeriod);
    for (int axis = 0; axis < 3; ++axis) {
      for (const Vector3<double>& tip : {tips.left, tips.right})
        worst = std::max(worst, std::abs(tip[axis] - limits.centre[axis]) - limits.half[axis]);
      for (const Vector3<double>& velocity : {tips.left_velocity, tips.right_velocity})
        worst = std::max(worst, std::abs(velocity[axis]) - limits.speed);
    }
    worst = std::max(worst, (tips.left - tips.right).norm() - kLength + limits.string_margin);
    worst = std::max(worst, limits.gap - (tips.left.y() - tips.right.y()));
  }
  for (std::size_t side = 0; side < 2; ++side)
    worst = std::max(worst, (end.velocity[side] - begin.velocity[side]).lpNorm<Eigen::Infinity>() / kPeriod -
                                limits.acceleration);
  return worst;
}

}  // namespace

TEST_CASE("hands keep every limit, whatever they are asked for") {
  Random random(2401);
  const HandLimits limits;
  for (int run = 0; run < 300; ++run) {
    Hands hands = at_home(limits);
    std::array<double, 6> action{};
    double worst = 0.0;
    for (int k = 0; k < 400; ++k) {
      const bool held = random.chance(0.9);  // long pushes meet the walls at full speed
      for (double& share : action)
        if (!held) share = random.chance(0.5) ? random.uniform(-3.0, 3.0) : random.chance(0.5) ? 1.0 : -1.0;
      const Hands begin = hands;
      move_hands(hands, action.data(), limits, kLength, kPeriod);
      worst = std::max(worst, beyond(begin, hands, limits));
    }
    CHECK(worst < 1e-9);
  }
}

TEST_CASE("far from the limits hands accelerate as they are asked") {
  const HandLimits limits;
  Hands hands = at_home(limits);
  const std::array<double, 6> action{0.1, -0.2, 0.3, 0.0, 0.2, -0.1};
  for (int k = 0; k < 5; ++k) move_hands(hands, action.data(), limits, kLength, kPeriod);
  const double t = 5 * kPeriod;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = limits.acceleration * action[static_cast<std::size_t>(axis)];
    CHECK(hands.velocity[0][axis] == Approx(a * t));
    CHECK(hands.position[0][axis] - at_home(limits).position[0][axis] == Approx(0.5 * a * t * t));
  }
}

TEST_CASE("hands reach the walls of their box, and the string's end") {
  HandLimits limits;
  Hands hands = at_home(limits);
  const std::array<double, 6> apart{0.0, 1.0, 0.0, 0.0, -1.0, 0.0}, up{1.0, 0.0, 1.0, 1.0, 0.0, 1.0};
  for (int k = 0; k < 300; ++k) move_hands(hands, up.data(), limits, kLength, kPeriod);
  for (const Vector3<double>& tip : hands.position) {
    CHECK(tip.x() == Approx(limits.centre.x() + limits.half.x()).margin(1e-3));
    CHECK(tip.z() == Approx(limits.centre.z() + limits.half.z()).margin(1e-3));
  }
  for (int k = 0; k < 300; ++k) move_hands(hands, apart.data(), limits, kLength, kPeriod);
  CHECK((hands.position[0] - hands.position[1]).norm() == Approx(2.0 * limits.half.y()).margin(1e-3));
  limits.half.y() = 0.8;
  for (int k = 0; k < 300; ++k) move_hands(hands, apart.data(), limits, kLength, kPeriod);
  CHECK((hands.position[0] - hands.position[1]).norm() ==
        Approx(kLength - limits.string_margin).margin(1e-3));
}

TEST_CASE("hands move as mirrored by mirrored actions") {
  Random random(2402);
  const HandLimits limits;
  Hands hands = at_home(limits), mirrored = hands;
  for (int k = 0; k < 500; ++k) {
    std::array<double, 6> action;
    for (double& share : action) share = random.uniform(-1.5, 1.5);
    const std::array<double, 6> other{action[3], -action[4], action[5], action[0], -action[1], action[2]};
    move_hands(hands, action.data(), limits, kLength, kPeriod);
    move_hands(mirrored, other.data(), limits, kLength, kPeriod);
    const Vector3<double> flip(1.0, -1.0, 1.0);
    CHECK((hands.position[0] - mirrored.position[1].cwiseProduct(flip)).norm() < 1e-12);
  }
}

TEST_CASE("limits that no hands can keep are refused with a sentence") {
  HandLimits limits;
  limits.speed = 0.0;
  CHECK_THROWS_WITH(limits.validate(), "limits, speed: 0; expected a positive number up to 1000");
  limits = {.gap = 0.8};
  CHECK_THROWS_WITH(limits.validate(), Contains("limits, gap: 0.8 m; expected at least 0"));
}
