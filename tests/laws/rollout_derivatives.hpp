// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/rollout.hpp"
#include "smooth_tips.hpp"

/// Derivatives of whole rollouts: duals against central differences.
namespace rollout_derivatives {

using namespace diabolo;
using Vector = Vector3<double>;

inline constexpr int kInputs = 13;
using Inputs = Eigen::Matrix<double, kInputs, 1>;
using Outputs = Eigen::Matrix<double, 7, 1>;  ///< position, velocity, spin
using D = Dual<double, kInputs>;

inline constexpr const char* kNames[kInputs] = {
    "position x",       "position y",    "position z",  "velocity x",
    "velocity y",       "velocity z",    "spin",        "string length",
    "gravity",          "spin coupling", "dissipation", "left tip's height",
    "right tip's swing"};

/// A play, as a function of its inputs.
struct Play {
  SmoothTips player;
  Parameters<double> parameters;
  Inputs inputs = Inputs::Zero();
  StringState string_state = StringState::kLoose;
  double dt = 1e-3;
  int steps = 500;
};

/// What happened on the way.
struct Events {
  int snaps = 0, catches = 0, slackenings = 0;
};

template <class Scalar>
std::array<Scalar, 7> run(const Play& play, const std::array<Scalar, kInputs>& x, Events* events = nullptr) {
  Parameters<Scalar> parameters;
  parameters.copy_rules(play.parameters);
  std::vector<double> fields;
  Parameters<double>::for_each(play.parameters,
                               [&](const ParameterInfo&, const double& f) { fields.push_back(f); });
  std::size_t next_field = 0;
  Parameters<Scalar>::for_each(parameters,
                               [&](const ParameterInfo&, Scalar& f) { f = Scalar(fields[next_field++]); });
  parameters.string_length = x[7];
  parameters.gravity = x[8];
  parameters.spin_coupling = x[9];
  parameters.dissipation_rate = x[10];
  const Predictor<Scalar> predictor(parameters);
  const auto cast = [](const Vector& v) { return Vector3<Scalar>(Scalar(v[0]), Scalar(v[1]), Scalar(v[2])); };
  const auto tips_at = [&](double t) {
    const Tips<double> given = play.player.at(t);
    const Vector swing = given.right - play.player.right.center;
    Tips<Scalar> tips{cast(given.left), cast(play.player.right.center), cast(given.left_velocity),
                      cast(given.right_velocity)};
    tips.left.z() += x[11];
    for (int k = 0; k < 3; ++k) {
      tips.right[k] += x[12] * Scalar(swing[k]);
      tips.right_velocity[k] = x[12] * tips.right_velocity[k];
    }
    return tips;
  };
  State<Scalar> state;
  state.position = Vector3<Scalar>(x[0], x[1], x[2]);
  state.velocity = Vector3<Scalar>(x[3], x[4], x[5]);
  state.spin = x[6];
  state.string_state = play.string_state;
  bool was_taut = false;
  for (int i = 0; i < play.steps; ++i) {
    const StepStatus<Scalar> status =
        predictor.step(state, tips_at(i * play.dt), tips_at((i + 1) * play.dt), Scalar(play.dt));
    if (events != nullptr) {
      const bool taut = value_of(squared_norm(state.string_acceleration)) > 0.0;
      events->snaps += status.snapped_taut;
      events->catches += status.caught;
      events->slackenings += was_taut && !taut;
      was_taut = taut;
    }
  }
  return {state.position[0], state.position[1], state.position[2], state.velocity[0],
          state.velocity[1], state.velocity[2], state.spin};
}

inline Outputs values(const Play& play, const Inputs& inputs) {
  std::array<double, kInputs> x{};
  for (int k = 0; k < kInputs; ++k) x[static_cast<std::size_t>(k)] = inputs[k];
  const std::array<double, 7> result = run<double>(play, x);
  return Eigen::Map<const Outputs>(result.data());
}

struct Tally {
  int compared = 0, kinks = 0;
  double worst = 0.0;  ///< of |dual - difference| / (1 + |difference|)
  Events events;
};

/// Compares every derivative of one play. Where the difference quotients of two steps disagree, the play has
/// a kink nearby (a diabolo about to be caught or not); it is counted and left out.
inline void compare(const Play& play, Tally& tally, double step = 1e-5) {
  std::array<D, kInputs> x;
  for (int k = 0; k < kInputs; ++k) x[static_cast<std::size_t>(k)] = D::variable(play.inputs[k], k);
  const std::array<D, 7> dual = run<D>(play, x, &tally.events);
  for (int k = 0; k < kInputs; ++k) {
    const auto difference = [&](double h) {
      Inputs up = play.inputs, down = play.inputs;
      up[k] += h;
      down[k] -= h;
      return Outputs((values(play, up) - values(play, down)) / (2.0 * h));
    };
    const Outputs coarse = difference(2.0 * step), fine = difference(step);
    if ((coarse - fine).norm() > 1e-2 * (1.0 + fine.norm())) {
      ++tally.kinks;
      continue;
    }
    ++tally.compared;
    double off = 0.0;
    for (int j = 0; j < 7; ++j)
      off = std::max(off, std::abs(dual[static_cast<std::size_t>(j)].gradient[k] - fine[j]));
    const double relative = off / (1.0 + fine.norm());
    if (relative > tally.worst) tally.worst = relative;
    CAPTURE(kNames[k], fine.transpose(), off);
    CHECK(relative < 5e-4);  // measured 1.1e-4, from the difference: positions solved to 1e-10 over the step
  }
}

}  // namespace rollout_derivatives
