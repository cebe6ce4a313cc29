// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <stdexcept>

#include "diabolo/estimate/measurements.hpp"
#include "diabolo/predictor.hpp"

// What an estimator cannot begin or go on from. All throw std::invalid_argument naming the field.
namespace diabolo::estimate_detail {

inline void expect_tips(const char* what, const Tips<double>& tips) {
  expect_within(what, "tips", tips.left, 1e4);
  expect_within(what, "tips", tips.right, 1e4);
  expect_within(what, "tips' velocities", tips.left_velocity, 1e4);
  expect_within(what, "tips' velocities", tips.right_velocity, 1e4);
}

inline void check_start(const State<double>& start, const Tips<double>& tips, double time) {
  expect_finite("start, time", std::isfinite(time));
  expect_finite("start", is_finite(start));
  if (!(std::abs(start.axis.norm() - 1.0) < 1e-6))
    throw std::invalid_argument("start, axis: norm " + shown(start.axis.norm()) + "; expected a unit vector");
  expect_tips("start", tips);
}

/// Bounces of a string that stretches are faster than what an estimate follows.
template <template <class> class... Effects>
void refuse_spring(const Predictor<double, Effects...>& predictor, State<double> start,
                   const Tips<double>& tips) {
  const auto& effects = predictor.effects();
  const auto& parameters = predictor.parameters();
  const double compliance = effects.string_at(effects.string(parameters), start, tips, parameters).compliance;
  if (compliance != 0.0)
    throw std::invalid_argument("estimator, string: compliance " + shown(compliance / parameters.mass) +
                                " m/N; expected a model without string_elasticity and stick_flex");
  if (parameters.follow_turns)
    throw std::invalid_argument("estimator, follow_turns: true; expected a string whose turns do not change");
  if (parameters.string_law != StringLaw::kInextensible)
    throw std::invalid_argument("estimator, string_law: pull_velocity; expected inextensible");
}

}  // namespace diabolo::estimate_detail
