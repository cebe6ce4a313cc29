// SPDX-License-Identifier: MIT
// Derivatives under the paper's and the published rules, within the smooth pieces of their motion.

#include "laws/rollout_derivatives.hpp"

using namespace rollout_derivatives;

namespace {

/// Held on the string all the time, by tips that rise steadily; or flying; or loose.
Play piece(Random& random, const Parameters<double>& parameters, StringState string_state) {
  Play play;
  play.parameters = parameters;
  play.player = SmoothTips::random(random, random.uniform(0.2, 0.6), 0.02, 5.0);
  play.string_state = string_state;
  play.steps = 100;
  const Tips<double> begin = play.player.at(0.0);
  const Spheroid<double> spheroid(begin.left, begin.right, parameters.string_length);
  const double outside = string_state == StringState::kOnString ? -2e-3 : 0.3;
  const Vector position = spheroid.center() + random.vector(0.1).cwiseProduct(Vector(1.0, 1.0, 0.0)) -
                          Vector(0.0, 0.0, spheroid.semi_minor() - outside);
  const Vector velocity =
      string_state == StringState::kOnString ? Vector(0.2, 0.1, -0.5) : Vector(0.2, 0.1, 0.4);
  play.inputs << position, velocity, 60.0, parameters.string_length, parameters.gravity,
      parameters.spin_coupling, parameters.dissipation_rate, 0.0, 1.0;
  return play;
}

}  // namespace

TEST_CASE("derivatives on the string, loose and in flight") {
  for (const auto preset : {&Parameters<double>::paper, &Parameters<double>::published})
    for (const StringState string_state :
         {StringState::kOnString, StringState::kLoose, StringState::kFlying}) {
      Random random(910);
      Tally tally;
      for (int i = 0; i < 6; ++i) compare(piece(random, preset(), string_state), tally);
      CAPTURE(static_cast<int>(string_state), tally.worst, tally.kinks);
      CHECK(tally.compared == 6 * kInputs);
    }
}
