// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "diabolo/predictor.hpp"
#include "diabolo/string/strands.hpp"

namespace diabolo {

/// What the string gave the diabolo in a step that the predictor made, friction too [m/s^2]: its mean
/// acceleration less gravity and what other effects push.
template <template <class> class... Effects>
Vector3<double> string_pull(const Predictor<double, Effects...>& predictor, const State<double>& before,
                            const State<double>& after, const Tips<double>& begin, double dt) {
  return (after.velocity - before.velocity) / dt -
         predictor.effects().acceleration(before, begin, dt, predictor.parameters());
}

/// Mean tensions of the left and the right strand over a step that the predictor made [N], for the diabolo's
/// mass in its parameters; zero where the string is slack at the end. While the string slips over the axle
/// they are as exp(c b), c the friction and b the angle around the axle.
template <template <class> class... Effects>
std::pair<double, double> strand_tensions(const Predictor<double, Effects...>& predictor,
                                          const State<double>& before, const State<double>& after,
                                          const Tips<double>& begin, const Tips<double>& end, double dt) {
  if (after.string_state != StringState::kOnString) return {0.0, 0.0};
  return Strands::halfway(before, after, begin, end)
      .tensions(predictor.parameters().mass * string_pull(predictor, before, after, begin, dt));
}

}  // namespace diabolo
