// SPDX-License-Identifier: MIT
#include "diabolo/effects/gyroscopic_tilt.hpp"

#include "diabolo/evaluate/baseline.hpp"
#include "diabolo/string/hanging.hpp"
#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

constexpr double kGain = 3.5, kApart = 0.25;

Full tilting(double gain) {
  Numbers parameters;
  parameters.spin_coupling = 0.0;  // the spin stays as it is
  return full<GyroscopicTilt>([&](auto& tilt) { tilt.gain = gain; }, parameters);
}

/// Sticks at rest, the left tip forward by `left` and the right one by `right` [m].
Tips<double> held(double left, double right) { return {{left, kApart, 1.2}, {right, -kApart, 1.2}}; }

State<double> hanging(const Tips<double>& tips, double spin) {
  return hanging_state(tips.left, tips.right, 1.45, spin);
}

/// The axle of a rigid body under the pull of two strands along the tangents of its axle, by Euler's
/// equations with the whole angular momentum: nothing is taken to be slow.
Vector rigid_axle(const Tips<double>& tips, double spin, double duration) {
  const double radius = 0.0065, mass = 0.29, inertia = mass * radius / kGain, ratio = 1.2;
  const Vector centre = lowest_point(tips.left, tips.right, 1.45), left = (tips.left - centre).normalized(),
               right = (tips.right - centre).normalized();
  const double tension = mass * kStandardGravity / (left + right).z();
  struct Body {
    Vector momentum, axle;
  };
  const auto rate = [&](const Body& body) {
    const auto torque = [&](const Vector& strand, const Vector& side) -> Vector {
      Vector normal = body.axle.cross(strand).normalized();
      if (normal.dot(side) < 0.0) normal = -normal;
      return radius * normal.cross(tension * strand);
    };
    const Vector total = torque(left, tips.left - tips.right) + torque(right, tips.right - tips.left);
    return Body{total, body.momentum.cross(body.axle) / (ratio * inertia)};
  };
  const auto moved = [](const Body& body, const Body& by, double dt) {
    return Body{body.momentum + by.momentum * dt, (body.axle + by.axle * dt).normalized()};
  };
  Body body{-inertia * spin * Vector::UnitX(), Vector::UnitX()};
  constexpr int kSteps = 20000;
  const double dt = duration / kSteps;
  for (int i = 0; i < kSteps; ++i) body = moved(body, rate(moved(body, rate(body), 0.5 * dt)), dt);
  return body.axle;
}

Vector axle_after(const Tips<double>& tips, double spin, double duration, double gain = kGain) {
  const Full model = tilting(gain);
  return run(
             model, hanging(tips, spin), [&](double) { return tips; }, duration,
             static_cast<int>(1000 * duration))
      .axis;
}

}  // namespace

TEST_CASE("a tilt of gain zero changes no bit") {
  const unsigned seed = 810;
  CAPTURE(seed);
  Full::Set set;
  CHECK(differing_steps(set, seed) == 0);
  set.get<GyroscopicTilt>().gain = 1e-6;
  CHECK(differing_steps(set, seed) > 1000);
}

TEST_CASE("one hand forward and the other back tilts the axle, both forward yaw it") {
  for (const double spin : {150.0, -150.0}) {
    CAPTURE(spin);
    const Vector opposed = axle_after(held(0.05, -0.05), spin, 1.0);
    CHECK(opposed.z() * spin > 0.01 * std::abs(spin));
    CHECK(std::abs(opposed.y()) < 0.05 * std::abs(opposed.z()));
  }
  // (The diabolo hangs below the tips' middle: both forward are the same as none.)
  const Vector level = axle_after(held(0.05, 0.05), 150.0, 1.0);
  CHECK(std::abs(level.z()) < 1e-12);
  CHECK(std::abs(level.y()) < 1e-12);
  Tips<double> tips = held(0.05, 0.05);
  State<double> state = hanging(held(0.0, 0.0), 150.0);  // behind them
  Full model = tilting(kGain);
  model.step(state, tips, tips, 1e-3);
  CHECK(std::abs(state.axis.y()) > 10.0 * std::abs(state.axis.z()));
  CHECK(state.axis.norm() == Approx(1.0).epsilon(1e-14));
}

TEST_CASE("the axle of a fast diabolo turns as a rigid body's does") {
  for (const double spin : {80.0, 150.0, -150.0, 300.0})
    for (const auto& [left, right] : {std::pair(0.05, -0.05), {0.03, 0.0}, {-0.08, 0.02}}) {
      CAPTURE(spin, left, right);
      const Vector whole = rigid_axle(held(left, right), spin, 1.0) - Vector::UnitX(),
                   slow = axle_after(held(left, right), spin, 1.0) - Vector::UnitX();
      CHECK(slow.norm() > 2e-3);
      // The nutation has the size of the slow turn within a period, some 1 / spin.
      CHECK((whole - slow).norm() < 0.02 * whole.norm() + 3.0 / (spin * spin));
    }
}

TEST_CASE("strands that friction parts turn the axle each by its own tension") {
  const Tips<double> tips = held(0.08, 0.05);
  const double spin = 200.0, coefficient = 0.25;
  State<double> state = hanging(held(0.0, 0.0), spin);
  Full::Set set;
  set.get<GyroscopicTilt>().gain = kGain;
  set.get<StringFriction>().coefficient = coefficient;
  const Full model(Numbers(), set);
  model.step(state, tips, tips, 1e-5);
  // By the capstan law and cross products: the axle slips fast towards the right tip under the string, which
  // drags it to the left.
  const Vector left = (tips.left - state.position).normalized(),
               right = (tips.right - state.position).normalized(), axle = Vector::UnitX();
  const double contact = std::acos(-left.dot(right)), ratio = std::exp(-coefficient * contact);
  const double mean = state.string_acceleration.norm() / (left + right).norm(),
               on_left = 2.0 * mean / (1.0 + ratio), on_right = ratio * on_left;
  const auto torque = [&](const Vector& strand, const Vector& side, double pull) -> Vector {
    Vector normal = axle.cross(strand).normalized();
    if (normal.dot(side) < 0.0) normal = -normal;
    return normal.cross(pull * strand);
  };
  Vector total = torque(left, Vector::UnitY(), on_left) + torque(right, -Vector::UnitY(), on_right);
  total -= axle * axle.dot(total);
  const Vector expected = -kGain / spin * total, rate = (state.axis - axle) / 1e-5;
  CHECK((rate - expected).norm() < 0.01 * expected.norm());
  const Vector equal = torque(left, Vector::UnitY(), mean) + torque(right, -Vector::UnitY(), mean);
  CHECK((total - (equal - axle * axle.dot(equal))).norm() > 0.2 * total.norm());
}

TEST_CASE("the slower the spin the faster the tilt, until the law fades") {
  const Tips<double> tips = held(0.04, -0.04);
  const double slow = axle_after(tips, 60.0, 0.2).z(), fast = axle_after(tips, 240.0, 0.2).z();
  CHECK(slow / fast == Approx(4.0).epsilon(0.02));
  CHECK(axle_after(tips, 0.0, 0.2) == Vector::UnitX());
  CHECK(axle_after(tips, 60.0, 0.2, 2.0 * kGain).z() == Approx(2.0 * slow).epsilon(1e-3));
}

TEST_CASE("a tilt is the same in a mirror, and however the world is turned") {
  const unsigned seed = 811;
  CAPTURE(seed);
  Random random(seed);
  const Full model = tilting(kGain);
  const Eigen::Matrix3d turn = about_vertical(1.1);
  for (int episode = 0; episode < 20; ++episode) {
    const Scene scene = hanging_scene(random);
    const auto at = [&](double t) { return scene.tips.at(t); };
    const State<double> plain = run(model, scene.start, at, 0.5, 500);
    CHECK((plain.axis - scene.start.axis).norm() > 1e-4);
    const auto reflected = [&](double t) { return mirrored(at(t)); };
    CHECK((run(model, mirrored(scene.start), reflected, 0.5, 500).axis - mirrored(plain.axis)).norm() < 1e-8);
    const auto rotated = [&](double t) { return turned(at(t), turn); };
    CHECK((run(model, turned(scene.start, turn), rotated, 0.5, 500).axis - turn * plain.axis).norm() < 1e-8);
  }
}

TEST_CASE("a tilt converges with the step, and a flight keeps the axle") {
  const unsigned seed = 812;
  CAPTURE(seed);
  Random random(seed);
  const Scene scene = hanging_scene(random);
  const auto tilted = [](const State<double>& a, const State<double>& b) { return (a.axis - b.axis).norm(); };
  CHECK(halving_ratio(tilting(kGain), scene, 250, tilted) > 1.8);
  State<double> free = flying({1.0, 2.0, 3.0}, 100.0);
  CHECK(fly(tilting(kGain), free, 0.5, 500).axis == free.axis);
}
