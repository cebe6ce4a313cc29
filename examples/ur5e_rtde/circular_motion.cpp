// SPDX-License-Identifier: MIT
#include "circular_motion.hpp"

#include <stdexcept>
#include <string>

#include "diabolo/effects/string_friction.hpp"
#include "diabolo/plan/player.hpp"

namespace ur5e {

diabolo::TipPath<double> circular_motion(double seconds, double spin) {
  using namespace diabolo;
  if (!(seconds > 0 && seconds <= 600))
    throw std::invalid_argument("seconds: " + diabolo::shown(seconds) + " s; must be within 0 and 600 s");
  constexpr const char* kName = "circular_acceleration";
  EffectSet<double, StringFriction> effects;
  effects.get<StringFriction>().coefficient = 0.25;
  effects.get<StringFriction>().spin_gain = 6;  // [1/m], about that of the paper's diabolos
  Parameters<double> parameters = Parameters<double>::consistent();
  parameters.spin_coupling = 0;
  const Predictor<double, StringFriction> model(parameters, effects);
  const double length = model.parameters().string_length;
  const TipColumn<double> home = home_pose(kName, length);
  RecedingHorizon<StringFriction> horizon(model, home, hanging_state(home, length, spin), 0.0);
  while (horizon.path().end() < seconds) {
    const Seam seam = horizon.seam_at(horizon.path().end());
    const Action action = action_named(kName, seam.tips, seam.state, length, {.spin_gain = 3.0});
    const PlanProblem<StringFriction> problem{{model},      seam.state, joined_at(seam, action.seed),
                                              action.goals, {},         action.freedom};
    horizon.join(seam, GradientSearch{}(problem, {}), seam.time, 0.0);
  }
  return horizon.path();
}

}  // namespace ur5e
