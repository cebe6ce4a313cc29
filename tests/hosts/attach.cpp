// SPDX-License-Identifier: MIT
#include "diabolo/hosts/attach.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "catch.hpp"

using namespace diabolo;

namespace {

constexpr double kInertia = 5.6e-4, kDt = 1e-3;

/// Tips that swing and beat.
Tips<double> tips_at(double t) {
  const double sway = 0.05 * (1.0 - std::cos(4.7 * t)), beat = 0.05 * (1.0 - std::cos(9.4 * t));
  Tips<double> tips;
  tips.time = t;
  tips.left = Vector3<double>(sway, 0.4, 1.3 + beat);
  tips.right = Vector3<double>(-sway, -0.4, 1.3 - 0.5 * beat);
  tips.left_velocity = Vector3<double>(0.235 * std::sin(4.7 * t), 0.0, 0.47 * std::sin(9.4 * t));
  tips.right_velocity = Vector3<double>(-0.235 * std::sin(4.7 * t), 0.0, -0.235 * std::sin(9.4 * t));
  tips.left_direction = Vector3<double>(0.9, 0.1, 0.0).normalized();
  tips.right_direction = Vector3<double>(0.9, -0.1, 0.0).normalized();
  return tips;
}

FullPredictor<double> predictor_with_all() {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.2;
  effects.get<StringElasticity>().compliance_per_newton = 5e-4;
  effects.get<StringElasticity>().damping = 5.0;
  effects.get<StickFlex>().compliance = 0.004;
  effects.get<FiniteAxle>().radius = 0.0065;
  effects.get<Air>().linear_drag = 0.05;
  effects.get<Air>().quadratic_drag = 0.02;
  effects.get<MagnusLift>().coefficient = 1e-3;
  effects.get<SpinLoss>().air = 1e-4;
  effects.get<GravityTilt>().x = 0.01;
  return FullPredictor<double>(Parameters<double>(), effects);
}

/// On the string, at rest under the middle of the tips.
State<double> start() {
  State<double> state;
  const Tips<double> tips = tips_at(0.0);
  const double half = 0.5 * (tips.left - tips.right).norm(),
               length = 0.5 * Parameters<double>().string_length;
  state.position =
      0.5 * (tips.left + tips.right) - Vector3<double>(0.0, 0.0, std::sqrt(length * length - half * half));
  state.velocity = Vector3<double>(0.3, 0.2, 0.0);
  state.spin = 60.0;
  state.string_state = StringState::kOnString;
  return state;
}

/// Somebody else's simulator: a free body, moved in one of two ways.
struct Host {
  HostMotion motion;
  double mass;
  HostBody body;
  Vector3<double> gravity{0.0, 0.0, -9.81};
  StringMemory memory;

  Host(HostMotion how, double its_mass) : motion(how), mass(its_mass) {
    const State<double> state = start();
    body.position = state.position;
    body.velocity = state.velocity;
    body.axle_rate = -state.spin;
    memory.string_state = state.string_state;
  }

  StringWrench step(const AttachedString& string, double t, double dt) {
    const StringWrench wrench = string.step(body, tips_at(t), tips_at(t + dt), dt, memory);
    const Vector3<double> acceleration = wrench.force / mass + gravity;
    if (motion == HostMotion::kConstantForce)
      body.position += body.velocity * dt + acceleration * (0.5 * dt * dt);
    body.velocity += acceleration * dt;
    if (motion == HostMotion::kNewVelocity) body.position += body.velocity * dt;
    body.axle_rate += wrench.torque.dot(body.axle) / kInertia * dt;
    return wrench;
  }
};

/// Farthest that a host's body is from the plain predictor in two seconds [m].
double farthest(HostMotion motion, const FullPredictor<double>& predictor, double dt) {
  const double mass = predictor.parameters().mass;
  Host host(motion, mass);
  const AttachedString string(predictor, mass, kInertia, host.gravity, motion);
  State<double> plain = start();
  double most = 0.0;
  for (int i = 0; i * dt < 2.0; ++i) {
    host.step(string, i * dt, dt);
    predictor.step(plain, tips_at(i * dt), tips_at((i + 1) * dt), dt);
    most = std::max(most, (host.body.position - plain.position).norm());
    CHECK(std::abs(host.body.axle_rate + plain.spin) < 1e-3);
  }
  return most;
}

}  // namespace

TEST_CASE("a host's body goes where the predictor goes") {
  for (const FullPredictor<double>& predictor :
       {predictor_with_all(), FullPredictor<double>(Parameters<double>(), {})}) {
    CHECK(farthest(HostMotion::kNewVelocity, predictor, kDt) < 1e-9);
    const double coarse = farthest(HostMotion::kConstantForce, predictor, kDt),
                 fine = farthest(HostMotion::kConstantForce, predictor, 0.5 * kDt);
    CAPTURE(coarse, fine);
    CHECK(coarse < 1e-6);
    CHECK(fine < 0.3 * coarse);  // second order
  }
}

TEST_CASE("a catch from afar gives the tips what it gives the body") {
  const AttachedString string(FullPredictor<double>(Parameters<double>(), {}), 0.2, kInertia,
                              {0.0, 0.0, -9.81});
  HostBody body;
  body.position = Vector3<double>(0.0, 0.0, 0.7);
  Tips<double> tips;
  tips.left = Vector3<double>(0.0, 0.72, 1.3);
  tips.right = Vector3<double>(0.0, -0.72, 1.3);
  StringMemory memory;
  const StringWrench wrench = string.step(body, tips, tips, kDt, memory);
  CHECK(wrench.force.z() > 1e4);
  CHECK((wrench.force + wrench.on_left + wrench.on_right).norm() < 1e-3 * wrench.force.norm());
  CHECK_FALSE(wrench.overstretched);
  tips.left.y() = 0.8;
  CHECK(string.step(body, tips, tips, kDt, memory).overstretched);
}

TEST_CASE("what is kept is numbers and back") {
  const StringMemory kept{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, StringState::kFlying, 0.5};
  const StringMemory::Numbers numbers{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 2.0, 0.5};
  CHECK(kept.numbers() == numbers);
  CHECK(StringMemory::of(numbers).numbers() == numbers);
  CHECK_THROWS_WITH(StringMemory::of({0, 0, 0, 0, 0, 0, 0.5, 0}),
                    "memory[6]: a string state of 0.5; expected 0, 1 or 2");
}

TEST_CASE("the host's gravity does not count twice, nor does another one's") {
  const FullPredictor<double> predictor = predictor_with_all();
  Host host(HostMotion::kNewVelocity, 0.2);
  host.gravity = Vector3<double>(0.0, 0.5, -3.0);
  const AttachedString string(predictor, host.mass, kInertia, host.gravity);
  State<double> plain = start();
  for (int i = 0; i < 500; ++i) {
    host.step(string, i * kDt, kDt);
    predictor.step(plain, tips_at(i * kDt), tips_at((i + 1) * kDt), kDt);
  }
  CHECK((host.body.position - plain.position).norm() < 1e-6);
}

TEST_CASE("what the body gets from the string, the tips give") {
  const FullPredictor<double> predictor(Parameters<double>(), {});
  Host host(HostMotion::kNewVelocity, Parameters<double>().mass);
  const AttachedString string(predictor, host.mass, kInertia, host.gravity);
  Vector3<double> sum = Vector3<double>::Zero(), given = sum;
  for (int i = 0; i < 2000; ++i) {
    const StringWrench wrench =
        string.step(host.body, tips_at(i * kDt), tips_at((i + 1) * kDt), kDt, host.memory);
    host.body.velocity += (wrench.force / host.mass + host.gravity) * kDt;
    host.body.position += host.body.velocity * kDt;
    sum += wrench.force * kDt;
    given -= (wrench.on_left + wrench.on_right) * kDt;
    CHECK(wrench.left_tension == Approx(wrench.right_tension).epsilon(0.01));
  }
  CHECK((sum - given).norm() < 1e-3 * sum.norm());
}

TEST_CASE("while the string slips its tensions are as Euler and Eytelwein have them") {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.2;
  const FullPredictor<double> predictor(Parameters<double>(), effects);
  Host host(HostMotion::kNewVelocity, Parameters<double>().mass);
  host.body.velocity.setZero();
  const AttachedString string(predictor, host.mass, kInertia, host.gravity);
  const Tips<double> still = tips_at(0.0);
  const StringWrench wrench = string.step(host.body, still, still, kDt, host.memory);
  const Vector3<double> left = (still.left - host.body.position).normalized(),
                        right = (still.right - host.body.position).normalized();
  const double angle = std::numbers::pi - std::acos(left.dot(right));
  CHECK(wrench.slip < -0.3);  // the axle spins towards the right, faster than the string
  CHECK(wrench.left_tension / wrench.right_tension == Approx(std::exp(0.2 * angle)).epsilon(0.01));
}

TEST_CASE("a slack string and a flying diabolo feel nothing; a saved step is done again to the bit") {
  const FullPredictor<double> predictor = predictor_with_all();
  Host host(HostMotion::kNewVelocity, 0.2);
  const AttachedString string(predictor_with_all(), host.mass, kInertia, host.gravity);
  for (int i = 0; i < 100; ++i) host.step(string, i * kDt, kDt);
  const Host saved = host;
  host.step(string, 0.1, kDt);
  Host again = saved;
  again.step(string, 0.1, kDt);
  CHECK(again.body.position == host.body.position);
  CHECK(again.memory.owed == host.memory.owed);

  const AttachedString plain(FullPredictor<double>(Parameters<double>(), {}), host.mass, kInertia,
                             host.gravity);
  host.body.position = Vector3<double>(0.0, 0.0, 1.2);
  host.body.velocity.setZero();
  host.memory = {};
  const Vector3<double> falls(0.0, 0.0, -kStandardGravity);
  const StringWrench wrench = plain.step(host.body, tips_at(0.0), tips_at(0.0), kDt, host.memory);
  CHECK(wrench.left_tension == 0.0);
  CHECK((wrench.force / host.mass + host.gravity - 0.5 * falls).norm() < 1e-9);  // half is owed
  CHECK((host.memory.owed - 0.5 * kDt * falls).norm() < 1e-12);
}

TEST_CASE("a body without mass is refused") {
  const FullPredictor<double> predictor(Parameters<double>(), {});
  CHECK_THROWS_AS(AttachedString(predictor, 0.0, 1.0, Vector3<double>::Zero()), std::invalid_argument);
  CHECK_THROWS_AS(AttachedString(predictor, 1.0, -1.0, Vector3<double>::Zero()), std::invalid_argument);
}

TEST_CASE("a host's memory counts the turns that a tip winds on") {
  Parameters<double> parameters;
  parameters.follow_turns = true;
  const double mass = parameters.mass;
  const AttachedString string(FullPredictor<double>(parameters), mass, kInertia, {0.0, 0.0, -9.81});
  HostBody body;
  body.position = {0.0, 0.03, 0.25};
  body.axle = Vector3<double>::UnitX();
  const auto tips = [](double t) {  // the right tip goes around the body, four times a second
    const double angle = -0.4 + 8.0 * std::numbers::pi * t;
    Tips<double> now;
    now.left = {0.0, 0.15, 1.1};
    now.right = {0.0, 0.4 * std::sin(angle), 0.2 + 0.4 * std::cos(angle)};
    return now;
  };
  StringMemory memory;
  for (int i = 0; i < 200; ++i) {
    const StringWrench wrench = string.step(body, tips(i * kDt), tips((i + 1) * kDt), kDt, memory);
    body.velocity += (wrench.force / mass + Vector3<double>(0.0, 0.0, -9.81)) * kDt;
    body.position += body.velocity * kDt;
  }
  CHECK(memory.turns > 1.0);
  CHECK(memory.turns < 1.5);
}
