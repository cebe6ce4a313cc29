// SPDX-License-Identifier: MIT
// Derivatives of the consistent string's motion, across snaps, slack and catches.

#include "laws/rollout_derivatives.hpp"

using namespace rollout_derivatives;

namespace {

Play random_play(Random& random, double distance, double height, const Vector& velocity,
                 StringState string_state) {
  Play play;
  play.parameters.dissipation_rate = 0.1;
  play.parameters.spin_coupling = 2.0;
  play.player = SmoothTips::random(random, distance, 0.08, 6.0);
  play.string_state = string_state;
  const Tips<double> begin = play.player.at(0.0);
  const Spheroid<double> spheroid(begin.left, begin.right, play.parameters.string_length);
  const Vector low = spheroid.closest_point(spheroid.center() + random.vector(0.2) - Vector(0.0, 0.0, 1.0));
  const Vector position = low + Vector(0.0, 0.0, height);
  const Vector start = velocity + random.vector(0.3);
  play.inputs << position, start, 60.0, play.parameters.string_length, play.parameters.gravity,
      play.parameters.spin_coupling, play.parameters.dissipation_rate, 0.0, 1.0;
  return play;
}

}  // namespace

TEST_CASE("derivatives of swings on the taut string") {
  Random random(900);
  Tally tally;
  for (int i = 0; i < 8; ++i) {
    // A start inside by 1 mm: on the surface itself a smaller string would begin outside.
    Play play = random_play(random, random.uniform(0.1, 0.8), 1e-3, Vector::Zero(), StringState::kOnString);
    compare(play, tally);
  }
  CAPTURE(tally.worst, tally.kinks);
  CHECK(tally.compared > 90);
}

TEST_CASE("derivatives of hops, across slack and snap") {
  Random random(901);
  Tally tally;
  for (int i = 0; i < 12; ++i) {
    const double distance = random.uniform(0.1, 0.8), height = random.uniform(0.02, 0.15);
    compare(random_play(random, distance, height, {0.0, 0.0, 1.0}, StringState::kLoose), tally);
  }
  CAPTURE(tally.worst, tally.kinks);
  CHECK(tally.events.snaps > 8);
  CHECK(tally.compared > 130);
}

TEST_CASE("derivatives of pulls that let the string go slack") {
  Random random(902);
  Tally tally;
  for (int i = 0; i < 20; ++i) {
    Play play = random_play(random, 0.4, 1e-3, Vector::Zero(), StringState::kOnString);
    play.player.left.amplitude.z() = play.player.right.amplitude.z() = 0.15;
    play.player.left.phase.z() = play.player.right.phase.z() = random.uniform(-1.0, 1.0);
    play.player.left.rate = play.player.right.rate = random.uniform(9.0, 14.0);
    compare(play, tally);
  }
  CAPTURE(tally.worst, tally.kinks);
  CHECK(tally.events.slackenings > 5);
  CHECK(tally.events.snaps > 20);
  CHECK(tally.compared > 200);
}

TEST_CASE("derivatives of throws, across the catch") {
  Random random(903);
  Tally tally;
  for (int i = 0; i < 20; ++i) {
    Play play = random_play(random, 1.43, 0.0, Vector::Zero(), StringState::kFlying);
    play.player.left.amplitude *= 0.05;
    play.player.right.amplitude *= 0.05;
    const Tips<double> begin = play.player.at(0.0);
    const Vector over = (begin.left + begin.right) / 2.0 + Vector(0.0, random.uniform(-0.3, 0.3), 0.2);
    play.inputs.head<3>() = over;
    play.inputs.segment<3>(3) = Vector{0.0, random.uniform(-0.3, 0.3), random.uniform(-2.0, 0.5)};
    play.steps = 400;
    compare(play, tally, 1e-6);
  }
  CAPTURE(tally.worst, tally.kinks);
  CHECK(tally.events.catches > 12);
  CHECK(tally.compared > 150);
}

TEST_CASE("at amplitude zero the derivative is that of the smallest amplitude") {
  Random random(904);
  for (int i = 0; i < 5; ++i) {
    Play play = random_play(random, 0.4, 0.05, Vector::Zero(), StringState::kLoose);
    play.inputs[10] = 0.0;  // no dissipation
    std::array<D, kInputs> x;
    for (int k = 0; k < kInputs; ++k) x[static_cast<std::size_t>(k)] = D::variable(play.inputs[k], k);
    const std::array<D, 7> dual = run<D>(play, x);
    Inputs little = play.inputs;
    little[10] = 1e-5;
    const Outputs difference = (values(play, little) - values(play, play.inputs)) / 1e-5;
    CHECK(difference.head<6>().norm() > 1e-3);
    for (int j = 0; j < 6; ++j)
      CHECK(dual[static_cast<std::size_t>(j)].gradient[10] ==
            Approx(difference[j]).margin(2e-3 * difference.norm()));
  }
}
