// SPDX-License-Identifier: MIT
#include "diabolo/effects/gyroscopic_tilt.hpp"

#include <numbers>

#include "diabolo/evaluate/baseline.hpp"
#include "diabolo/string/hanging.hpp"
#include "effects/rigid_top.hpp"
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

/// The same body as RigidTop, as the library knows it.
Full rigid(const RigidTop& top) {
  Full::Set set;
  set.get<GyroscopicTilt>().gain = top.mass * top.radius / top.axial;
  set.get<GyroscopicTilt>().inertia_ratio = top.transverse / top.axial;
  set.get<FiniteAxle>().radius = top.radius;
  set.get<FiniteAxle>().follows_axis = 1.0;
  set.get<Groove>().profile_radius = top.profile;
  set.get<Groove>().half_width = top.half_width;
  Numbers parameters;
  parameters.spin_coupling = 0.0;
  parameters.mass = top.mass;
  parameters.axle_radius = top.radius;
  parameters.string_length = top.length;
  return Full(parameters, set);
}

/// Angular momentum over the axial moment of inertia [rad/s].
Vector momentum(const State<double>& state, double ratio) {
  return state.tumble * ratio - state.axis * state.spin;
}

/// Hands that hold their tips at their places and set out from there, more and more.
struct Play {
  double ahead, swing, rate;  ///< one tip forward and the other back [m]; along all axes [m], [rad/s]

  Tips<double> at(double t) const {
    const double begun = 1.0 - std::exp(-4.0 * t * t), begins = 8.0 * t * std::exp(-4.0 * t * t);
    const double wave = std::sin(rate * t), waves = rate * std::cos(rate * t);
    const Vector out(ahead + 0.5 * swing * wave, swing * wave, 0.5 * swing * wave),
        outs(0.5 * swing * waves, swing * waves, 0.5 * swing * waves);
    const Vector place = out * begun, speed = out * begins + outs * begun, back(-2.0 * ahead, 0.0, 0.0);
    return {Vector(0.0, 0.3, 1.2) + place, Vector(0.0, -0.3, 1.2) + place + back * begun, speed,
            speed + back * begins};
  }
};

double degrees_between(const Vector& a, const Vector& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
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

TEST_CASE("strands that cross, and a string the other way round, turn the axle by where they leave it") {
  const double radius = 0.0065, dt = 1e-5, spin = 200.0;
  for (const bool crossed : {false, true})
    for (const double turns : {0.0, 1.0, -1.0}) {
      CAPTURE(crossed, turns);
      Numbers parameters = tilting(kGain).parameters();
      parameters.follow_turns = true;
      Full::Set set;
      set.get<GyroscopicTilt>().gain = kGain;
      const Full model(parameters, set);
      Tips<double> tips = held(0.06, 0.01);
      if (crossed) std::swap(tips.left.y(), tips.right.y());
      State<double> state = hanging(tips, spin);
      state.turns = turns;
      for (int i = 0; i < 200; ++i) model.step(state, tips, tips, 1e-3);
      // Where FiniteAxle lets the strands of such a string leave the axle.
      FiniteAxle<double> finite;
      finite.radius = radius;
      finite.follows_axis = 1.0;
      const TipShift<double> shift = finite.tip_shift(state, tips, parameters);
      const Vector axle = state.axis, left = (tips.left - state.position).normalized(),
                   right = (tips.right - state.position).normalized();
      const double pull = state.string_acceleration.norm() / (left + right).norm();
      const Vector total =
          (-shift.left / radius).cross(pull * left) + (-shift.right / radius).cross(pull * right);
      const Vector expected = -kGain / spin * (total - axle * axle.dot(total));
      model.step(state, tips, tips, dt);
      CHECK(((state.axis - axle) / dt - expected).norm() < 0.03 * expected.norm());
      CHECK(expected.norm() > 1e-4);
    }
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

TEST_CASE("a rigid axle in flight keeps its angular momentum and turns about it") {
  const double ratio = 1.2;
  Full::Set set;
  set.get<GyroscopicTilt>().gain = kGain;
  set.get<GyroscopicTilt>().inertia_ratio = ratio;
  const Full model(Numbers(), set);
  State<double> state = flying({0.5, 1.0, 2.0}, 90.0);
  state.axis = Vector(1.0, 0.2, -0.1).normalized();
  state.tumble = Vector(0.3, 1.0, 2.0).cross(state.axis);
  const Vector before = momentum(state, ratio);
  const auto after = [&](int steps) { return fly(model, state, 0.4, steps); };
  const State<double> end = after(400);
  CHECK((momentum(end, ratio) - before).norm() < 1e-11 * before.norm());
  CHECK(std::abs(end.axis.norm() - 1.0) < 1e-13);
  CHECK(std::abs(end.axis.dot(end.tumble)) < 1e-10);
  const Vector turned = Eigen::AngleAxisd(0.4 * before.norm() / ratio, before.normalized()) * state.axis;
  CHECK((turned - state.axis).norm() > 0.01);
  const double coarse = (after(400).axis - turned).norm(), fine = (after(800).axis - turned).norm();
  CHECK(fine < 1e-3);
  CHECK(coarse / fine == Approx(4.0).epsilon(0.05));
}

TEST_CASE("the lighter the cups are across the axle, the nearer a rigid axle comes to the fast one") {
  const Tips<double> tips = held(0.05, -0.05);
  const State<double> start = hanging(tips, 300.0);
  /// How far they are apart at most.
  const auto apart = [&](double ratio) {
    const Full fast = tilting(kGain), whole = full<GyroscopicTilt>(
                                          [&](auto&tilt) {
                                            tilt.gain = kGain;
                                            tilt.inertia_ratio = ratio;
                                          },
                                          fast.parameters());
    State<double> a = start, b = start;
    double worst = 0.0;
    for (int i = 0; i < 8000; ++i) {
      fast.step(a, tips, tips, 2.5e-5);
      whole.step(b, tips, tips, 2.5e-5);
      worst = std::max(worst, (a.axis - b.axis).norm());
    }
    CHECK((a.axis - start.axis).norm() > 20.0 * worst);
    return worst;
  };
  CHECK(apart(0.1) < 0.3 * apart(0.8));
}

TEST_CASE("a rigid axle and its diabolo move as a rigid top on springs, groove and all") {
  // (A groove makes a tilt grow by itself, the faster the slower the spin: what is apart grows with it.)
  struct Case {
    double spin;
    Play play;
    double profile;
  };
  for (const Case& wanted : {Case{50.0, {0.004, 0.05, 4.0}, 0.0}, Case{50.0, {0.002, 0.02, 3.0}, 0.002},
                             Case{-80.0, {0.02, 0.0, 0.0}, 0.0}, Case{-80.0, {0.004, 0.02, 4.0}, 0.004},
                             Case{150.0, {-0.03, 0.05, 3.0}, 0.0}, Case{150.0, {-0.03, 0.05, 3.0}, 0.01}}) {
    const auto& [spin, play, profile] = wanted;
    CAPTURE(spin, play.ahead, play.swing, profile);
    RigidTop top;
    top.profile = profile;
    top.half_width = 0.005;
    const auto tips = [&](double t) { return wanted.play.at(t); };
    const auto ends = [&](double t) {
      const Tips<double> x = tips(t);
      return RigidTop::Ends{x.left, x.right, x.left_velocity, x.right_velocity};
    };
    const Full model = rigid(top);
    State<double> state =
        hanging_state(tips(0.0).left, tips(0.0).right, top.length - std::numbers::pi * top.radius, spin);
    state.axis = Vector(1.0, 0.01, 0.01).normalized();
    const Vector start = state.axis;
    RigidTop::Body body = RigidTop::begin(state.position, state.velocity, state.axis, spin);
    double apart = 0.0, tilted = 0.0, turned = 0.0;
    for (int i = 0; i < 10000; ++i) {
      const double t = i * 1e-3;
      body = top.advanced(body, ends, t, 1e-4, 10);
      model.step(state, tips(t), tips(t + 1e-3), 1e-3);
      if (i < 2000) apart = std::max(apart, (body.place - state.position).norm());
      tilted = std::max(tilted, degrees_between(body.axes.col(0), state.axis));
      turned = std::max(turned, degrees_between(start, state.axis));
    }
    CHECK(turned > 2.0);
    CHECK(turned < 45.0);
    CHECK(tilted < 1.0);
    CHECK(apart < 0.002);
  }
}

TEST_CASE("a string without friction keeps the energy of a rigid diabolo") {
  RigidTop top;
  const Tips<double> tips = held(0.02, -0.02);
  const auto energy = [&](const State<double>& s) {
    return 0.5 * top.mass * s.velocity.squaredNorm() + top.mass * kStandardGravity * s.position.z() +
           0.5 * top.axial * s.spin * s.spin + 0.5 * top.transverse * s.tumble.squaredNorm();
  };
  const auto lost = [&](double dt) {
    const Full model = rigid(top);
    State<double> state =
        hanging_state(tips.left, tips.right, top.length - std::numbers::pi * top.radius, 60.0);
    state.position += Vector(0.0, 0.1, 0.0);
    state.tumble = Vector(0.0, 3.0, 0.0);
    model.step(state, tips, tips, dt);  // back on the string
    const double begin = energy(state);
    return energy(run(
               model, state, [&](double) { return tips; }, 3.0, static_cast<int>(3.0 / dt))) -
           begin;
  };
  const double coarse = lost(1e-3), fine = lost(0.5e-3);
  CAPTURE(coarse, fine);
  CHECK(std::abs(coarse) < 1e-5);
  CHECK(std::abs(fine) < 1e-5);
}

TEST_CASE("a nutation decays, and the slow turn stays") {
  const Tips<double> tips = held(0.05, -0.05);
  Full::Set set;
  set.get<GyroscopicTilt>().gain = kGain;
  set.get<GyroscopicTilt>().inertia_ratio = 1.2;
  const Full free(tilting(kGain).parameters(), set);
  set.get<GyroscopicTilt>().decay = 4.0;
  const Full calm(tilting(kGain).parameters(), set);
  State<double> start = hanging(tips, 120.0);
  start.tumble = Vector(0.0, 1.0, 0.0);
  const auto ends = [&](const Full& model) {
    return run(
        model, start, [&](double) { return tips; }, 2.0, 2000);
  };
  CHECK(ends(free).tumble.norm() > 0.8);
  CHECK(ends(calm).tumble.norm() < 0.1);
  CHECK((ends(calm).axis - axle_after(tips, 120.0, 2.0)).norm() < 0.015);
}

TEST_CASE("a rigid axle is the same in a mirror, and however the world is turned") {
  const unsigned seed = 813;
  CAPTURE(seed);
  RigidTop top;
  top.profile = 0.008;
  top.half_width = 0.003;
  const Full model = rigid(top);
  const Eigen::Matrix3d turn = about_vertical(-0.7);
  Random random(seed);
  for (int episode = 0; episode < 20; ++episode) {
    Scene scene = hanging_scene(random);
    scene.start.tumble = random.vector(2.0).cross(scene.start.axis);
    const auto at = [&](double t) { return scene.tips.at(t); };
    const auto reflected = [&](double t) { return mirrored(at(t)); };
    const auto rotated = [&](double t) { return turned(at(t), turn); };
    const auto apart = [](const State<double>& a, const State<double>& b) {
      return (a.axis - b.axis).norm() + (a.tumble - b.tumble).norm() + (a.position - b.position).norm();
    };
    const State<double> plain = run(model, scene.start, at, 0.3, 300);
    CHECK(apart(run(model, mirrored(scene.start), reflected, 0.3, 300), mirrored(plain)) < 1e-8);
    CHECK(apart(run(model, turned(scene.start, turn), rotated, 0.3, 300), turned(plain, turn)) < 1e-8);
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
