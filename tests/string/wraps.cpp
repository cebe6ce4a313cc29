// SPDX-License-Identifier: MIT
#include <numbers>

#include "diabolo/string/string_path.hpp"
#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

Full wrapped(double wraps, double friction, double radius, double length = 1.45) {
  Numbers numbers;
  numbers.wraps = wraps;
  numbers.string_length = length;
  Full::Set set;
  set.get<StringFriction>().coefficient = friction;
  set.get<FiniteAxle>().radius = radius;
  return Full(numbers, set);
}

}  // namespace

TEST_CASE("a wrap takes the axle's circumference from the string") {
  const unsigned seed = 1023;
  CAPTURE(seed);
  Random random(seed);
  const double radius = 0.0073, length = 1.45 + 2.0 * std::numbers::pi * radius;
  for (int trial = 0; trial < 20; ++trial) {
    CAPTURE(trial);
    const Scene scene = hanging_scene(random, 1.42);
    const auto tips = [&](double t) { return scene.tips.at(t); };
    const State<double> longer = run(wrapped(1.0, 0.0, radius, length), scene.start, tips, 0.3, 300),
                        plain = run(wrapped(0.0, 0.0, radius), scene.start, tips, 0.3, 300);
    CHECK((longer.position - plain.position).norm() < 1e-9);
  }
}

TEST_CASE("each wrap counts a whole turn in the capstan law") {
  const unsigned seed = 1024;
  CAPTURE(seed);
  Random random(seed);
  for (int trial = 0; trial < 20; ++trial) {
    CAPTURE(trial);
    const Scene scene = hanging_scene(random);
    const Tips<double> begin = scene.tips.at(0.0), end = scene.tips.at(1e-4);
    const double angle = contact_angle(StringPath<double>(scene.start.position, begin));
    const double turns = 2.0 * std::numbers::pi, friction = random.uniform(0.05, 0.3);
    const double stronger = friction * (angle + 2.0 * turns) / angle;
    State<double> wraps = scene.start, strong = scene.start, weak = scene.start;
    wrapped(2.0, friction, 0.0).step(wraps, begin, end, 1e-4);
    wrapped(0.0, stronger, 0.0).step(strong, begin, end, 1e-4);
    wrapped(0.0, friction, 0.0).step(weak, begin, end, 1e-4);
    CHECK((wraps.velocity - strong.velocity).norm() < 1e-3 * (wraps.velocity - weak.velocity).norm());
  }
}

TEST_CASE("a string around the axle keeps a diabolo that is thrown") {
  Tips<double> tips;
  tips.left = Vector(0.0, 0.2, 1.0);
  tips.right = Vector(0.0, -0.2, 1.0);
  State<double> state;
  state.position = Vector(0.0, 0.0, 0.4);
  state.velocity = Vector(0.0, 0.0, 4.5);
  state.string_state = StringState::kLoose;
  const auto at_rest = [&](double) { return tips; };
  CHECK(run(wrapped(0.0, 0.0, 0.0), state, at_rest, 0.4, 400).string_state == StringState::kFlying);
  CHECK(run(wrapped(1.0, 0.0, 0.0), state, at_rest, 0.4, 400).string_state != StringState::kFlying);
}
