// SPDX-License-Identifier: MIT
#include "diabolo/effects/unnamed_force.hpp"

#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

using Unnamed = UnnamedForce<double>;

template <class Change>
Full pushing(Change&& change, const Numbers& parameters = {}) {
  return full<UnnamedForce>(change, parameters);
}

Vector push(const Unnamed& force, const State<double>& state, const Tips<double>& tips = {}) {
  return force.acceleration(state, tips, 1e-3, Numbers());
}

}  // namespace

TEST_CASE("a force of amplitude zero changes no bit, whatever its powers") {
  const unsigned seed = 780;
  CAPTURE(seed);
  Full::Set set;
  set.get<UnnamedForce>().speed_exponent = 1.5;
  set.get<UnnamedForce>().spin_exponent = -0.5;
  CHECK(differing_steps(set, seed) == 0);
  set.get<UnnamedForce>().string_tangent = 1e-8;
  CHECK(differing_steps(set, seed) > 1000);
}

TEST_CASE("on the string it acts along it and across its plane, off it along the flight, up and sideways") {
  const Tips<double> tips{Vector(0.0, 0.3, 1.0), Vector(0.0, -0.3, 1.0), Vector::Zero(), Vector::Zero()};
  State<double> state;
  state.position = Vector(0.0, 0.0, 0.3);
  state.velocity = Vector(0.0, 0.0, 2.0);
  state.spin = 50.0;
  Unnamed force;
  force.string_tangent = 1.0;
  force.string_binormal = 2.0;
  state.string_state = StringState::kOnString;
  CHECK((push(force, state, tips) - Vector(2.0, -1.0, 0.0)).norm() < 1e-4);
  force.flight_against = 3.0;
  force.flight_vertical = 4.0;
  force.flight_lift = 5.0;
  CHECK((push(force, state, tips) - Vector(2.0, -1.0, 0.0)).norm() < 1e-4);
  for (const StringState off : {StringState::kFlying, StringState::kLoose}) {
    state.string_state = off;
    // The axle points forwards, x; the angular velocity is -spin * axis, and -x cross z is y.
    CHECK((push(force, state, tips) - Vector(0.0, 5.0, 1.0)).norm() < 1e-4);
    state.spin = -50.0;
    CHECK((push(force, state, tips) - Vector(0.0, -5.0, 1.0)).norm() < 1e-4);
    state.spin = 50.0;
  }
}

TEST_CASE("it grows by its powers of speed and spin, as far as its bounds") {
  const unsigned seed = 781;
  CAPTURE(seed);
  Random random(seed);
  for (int i = 0; i < 50; ++i) {
    Unnamed force;
    force.flight_vertical = random.uniform(-2.0, 2.0);
    force.speed_exponent = random.uniform(-2.0, 3.0);
    force.spin_exponent = random.uniform(-2.0, 3.0);
    State<double> state;
    state.string_state = StringState::kFlying;
    state.velocity = random.direction() * random.uniform(0.1, 10.0);
    state.spin = random.uniform(10.0, 500.0) * (random.chance(0.5) ? 1.0 : -1.0);
    const double expected = force.flight_vertical * std::pow(state.velocity.norm(), force.speed_exponent) *
                            std::pow(std::abs(state.spin) / 100.0, force.spin_exponent);
    CHECK(push(force, state).z() == Approx(expected).epsilon(1e-12));
    const auto at = [&](double speed, double spin) {
      state.velocity = Vector(speed, 0.0, 0.0);
      state.spin = spin;
      return push(force, state).z();
    };
    CHECK(at(0.0, 0.0) == Approx(at(Unnamed::kLeastSpeed, Unnamed::kLeastSpin)));
    CHECK(at(1e3, 1e5) == Approx(at(Unnamed::kMostSpeed, Unnamed::kMostSpin)));
  }
}

TEST_CASE("against the velocity with the power two it is the drag of the air") {
  const Vector velocity(1.0, 2.0, 3.0);
  const Full named = full<Air>([](auto& air) { air.quadratic_drag = 0.1; });
  const Full unnamed = pushing([](auto& force) {
    force.flight_against = 0.1;
    force.speed_exponent = 2.0;
  });
  const State<double> a = fly(named, flying(velocity), 0.5, 500),
                      b = fly(unnamed, flying(velocity), 0.5, 500);
  CHECK(apart(a, fly(Full(Numbers()), flying(velocity), 0.5, 500)) > 0.02);
  CHECK(apart(a, b) < 1e-6);  // the direction's smoothing
}

TEST_CASE("no step takes more than the velocity, however a force against it grows") {
  const Unnamed force = [] {
    Unnamed f;
    f.flight_against = 20.0;
    f.speed_exponent = -2.0;
    return f;
  }();
  State<double> state;
  state.string_state = StringState::kFlying;
  for (const double speed : {0.01, 0.1, 1.0, 3.0})
    for (const double dt : {1e-4, 1e-2, 0.1, 1.0}) {
      CAPTURE(speed, dt);
      state.velocity = Vector(0.0, speed, 0.0);
      const Vector after = state.velocity + force.acceleration(state, {}, dt, Numbers()) * dt;
      CHECK(after.y() >= 0.0);
      CHECK(after.y() < speed);
    }
}

TEST_CASE("mirrored and turned, a force without a name acts as before") {
  const unsigned seed = 782;
  CAPTURE(seed);
  const auto change = [](double tangent) {
    return [tangent](auto& force) {
      force.string_tangent = tangent;
      force.string_binormal = 0.3;
      force.speed_exponent = 1.5;
      force.spin_exponent = 0.5;
    };
  };
  const Full model = pushing(change(0.4));
  const auto mirror = [](const auto& x) { return mirrored(x); };
  CHECK(worst_of_symmetry(model, pushing(change(-0.4)), mirror, mirror, seed) < 1e-9);
  CHECK(worst_of_symmetry(model, model, mirror, mirror, seed) > 1e-3);
  const Eigen::Matrix3d turn = about_vertical(0.7);
  const auto rotate = [&](const auto& x) { return turned(x, turn); };
  CHECK(worst_of_symmetry(model, model, rotate, rotate, seed) < 1e-9);
}

TEST_CASE("a force without a name is of the first order of the step") {
  const unsigned seed = 783;
  CAPTURE(seed);
  Random random(seed);
  const Full model = pushing([](auto& force) {
    force.string_tangent = 0.5;
    force.string_binormal = 0.5;
    force.speed_exponent = 1.0;
  });
  for (int episode = 0; episode < 5; ++episode) {
    CAPTURE(episode);
    CHECK(halving_ratio(model, hanging_scene(random), 1000, apart) == Approx(2.0).epsilon(0.15));
  }
}
