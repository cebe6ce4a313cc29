// SPDX-License-Identifier: MIT
#include "diabolo/effects/unbalance.hpp"

#include "diabolo/string/hanging.hpp"
#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

constexpr double kTurnsBy = 3.5;

Full unbalanced(double offset, double gain = kTurnsBy) {
  Numbers parameters;
  parameters.spin_coupling = 0.0;
  Full::Set set;
  set.get<GyroscopicTilt>().gain = gain;
  set.get<Unbalance>().offset = offset;
  return Full(parameters, set);
}

}  // namespace

TEST_CASE("cups of unlike weight change no bit where nothing turns the axle") {
  const unsigned seed = 830;
  CAPTURE(seed);
  Full::Set set;
  set.get<Unbalance>().offset = 1e-3;
  CHECK(differing_steps(set, seed) == 0);
  set.get<GyroscopicTilt>().gain = kTurnsBy;
  CHECK(differing_steps(set, seed) > 1000);
}

TEST_CASE("an unbalanced diabolo that hangs yaws at the rate of a heavy top, slower the faster it spins") {
  const Tips<double> tips = level(0.6);
  const double offset = 8e-4, dt = 1e-4;
  for (const double spin : {60.0, 150.0, -150.0}) {
    CAPTURE(spin);
    const Full model = unbalanced(offset);
    State<double> state = hanging_state(tips.left, tips.right, 1.45, spin);
    for (int i = 0; i < 200; ++i) unbalanced(offset, 0.0).step(state, tips, tips, 1e-3);
    const Vector axle = state.axis;
    model.step(state, tips, tips, dt);
    // Momentum -I w s, weight m g in the centre of mass, offset s away from where it hangs.
    const double mass_over_inertia = kTurnsBy / model.parameters().axle_radius;
    const Vector weight(0.0, 0.0, -kStandardGravity);
    const Vector expected = -mass_over_inertia / spin * (offset * axle).cross(weight);
    CHECK(((state.axis - axle) / dt - expected).norm() < 0.01 * expected.norm());
  }
}

TEST_CASE("an unbalance is the same seen from the axle's other end") {
  const unsigned seed = 831;
  CAPTURE(seed);
  Random random(seed);
  for (int episode = 0; episode < 20; ++episode) {
    const Scene scene = hanging_scene(random);
    const auto at = [&](double t) { return scene.tips.at(t); };
    State<double> other = scene.start;
    other.axis = -other.axis;
    other.spin = -other.spin;
    const Vector one = run(unbalanced(1e-3), scene.start, at, 0.5, 500).axis,
                 two = run(unbalanced(-1e-3), other, at, 0.5, 500).axis,
                 balanced = run(unbalanced(0.0), scene.start, at, 0.5, 500).axis;
    CHECK((one + two).norm() < 1e-9);
    CHECK((one - balanced).norm() > 1e-3);
  }
}
