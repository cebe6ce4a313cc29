// SPDX-License-Identifier: MIT
#include "diabolo/estimate/chart.hpp"

#include "catch.hpp"
#include "random.hpp"

using namespace diabolo;

TEST_CASE("a state is where its chart says, axles of all directions") {
  using Chart = StateChart<true>;
  const unsigned seed = 81;
  CAPTURE(seed);
  Random random(seed);
  for (int trial = 0; trial < 100; ++trial) {
    State<double> origin;
    origin.position = random.vector(1.0);
    origin.velocity = random.vector(3.0);
    origin.spin = random.uniform(-200.0, 200.0);
    origin.axis = random.direction();
    origin.string_state = StringState::kFlying;
    ColumnOf<9> away;
    for (int i = 0; i < 9; ++i) away[i] = random.uniform(-0.5, 0.5);
    const State<double> state = Chart::at(origin, away);
    CHECK(state.axis.norm() == Approx(1.0));
    CHECK(state.string_state == StringState::kFlying);
    CHECK((Chart::from(origin, state) - away).norm() < 1e-12);
    CHECK((Chart::at(origin, ColumnOf<9>::Zero()).axis - origin.axis).norm() < 1e-15);
    // A small turn is by the angle that the numbers say.
    away.tail<2>() *= 1e-4;
    const double turned = std::acos(Chart::at(origin, away).axis.cross(origin.axis).norm());
    CHECK(std::cos(turned) == Approx(away.tail<2>().norm()).epsilon(1e-6));
  }
}
