// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "diabolo/predictor.hpp"

namespace diabolo {

/// Steps that a rollout takes: from `begin` in `count` equal steps of `dt` [s].
struct Steps {
  double begin = 0.0;  ///< time of the initial state [s]
  double dt = 1e-3;    ///< [s]
  std::size_t count = 0;

  /// Time after `i` steps [s].
  double time(std::size_t i) const { return begin + static_cast<double>(i) * dt; }

  /// Throws std::invalid_argument when dt is not positive or a time is not finite.
  void validate() const {
    if (!(dt > 0.0) || !std::isfinite(dt))
      throw std::invalid_argument("dt: " + std::to_string(dt) + " s; must be positive and finite");
    if (!std::isfinite(begin))
      throw std::invalid_argument("begin: the time of the initial state must be finite");
  }
};

/// Predicts `steps` from `state`, the tips following `motion`, and calls `visit(index, time, state, status)`
/// after each step with index 1 .. count. The caller keeps what it needs; nothing is stored. Returns the last
/// state. `motion` is a TipMotion, or anything else that has its at(time, hint). Throws std::invalid_argument
/// when dt is not positive and finite.
template <class Scalar, template <class> class... Effects, class Motion, class Visitor>
State<Scalar> rollout(const Predictor<Scalar, Effects...>& predictor, State<Scalar> state,
                      const Motion& motion, const Steps& steps, Visitor&& visit) {
  steps.validate();
  std::size_t hint = 0;
  Tips<Scalar> now = motion.at(steps.begin, hint);
  for (std::size_t i = 1; i <= steps.count; ++i) {
    const Tips<Scalar> next = motion.at(steps.time(i), hint);
    const StepStatus<Scalar> status = predictor.step(state, now, next, Scalar(steps.dt));
    visit(i, steps.time(i), state, status);
    now = next;
  }
  return state;
}

/// The same without looking at what lies between.
template <class Scalar, template <class> class... Effects, class Motion>
State<Scalar> rollout(const Predictor<Scalar, Effects...>& predictor, const State<Scalar>& state,
                      const Motion& motion, const Steps& steps) {
  return rollout(predictor, state, motion, steps,
                 [](std::size_t, double, const State<Scalar>&, const auto&) {});
}

}  // namespace diabolo
