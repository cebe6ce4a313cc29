// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "diabolo/estimate/passage.hpp"
#include "diabolo/estimate/within_string.hpp"

// The filter's two process models: the predictor's string, and the measured tensions alone.
namespace diabolo {

/// The predictor's steps. Where both pulls are sure the string is under the diabolo, and the difference of
/// the tensions is the measured one: friction is known less well.
template <bool kAxle, template <class> class... Effects>
Passage<kAxle> pass_on_string(const Predictor<double, Effects...>& predictor, const PulledStep& step,
                              const Belief<kAxle>& before) {
  State<double> from = before.state;
  if (step.sure() && from.string_state == StringState::kFlying) from.string_state = StringState::kLoose;
  return estimate_detail::passage<kAxle>(predictor, step, from, before.factor, [&](State<double>& state) {
    keep_within_string(predictor, state, step.begin, before.pulled);
    const State<double> start = state;
    predictor.step(state, step.begin, step.end, step.dt);
    const auto tensions = strand_tensions(predictor, start, state, step.begin, step.end, step.dt);
    if (step.sure() && state.string_state == StringState::kOnString)
      lean_by_tensions(
          state, pulling_strands(predictor, start, state, step.begin, step.end), predictor.parameters().mass,
          (step.read[1].tension - step.read[0].tension) - (tensions.second - tensions.first), step.dt);
    return tensions;
  });
}

/// Steps by the measured tensions alone: of a string that gives, and bounces. They say nothing of themselves
/// then. A diabolo that nothing pulls where the string does not reach is off it.
template <bool kAxle, template <class> class... Effects>
Passage<kAxle> pass_by_tensions(const Predictor<double, Effects...>& predictor, const PulledStep& step,
                                const Belief<kAxle>& before) {
  const double left = step.sure() ? step.read[0].tension : 0.0;
  const double right = step.sure() ? step.read[1].tension : 0.0;
  return estimate_detail::passage<kAxle>(
      predictor, step, before.state, before.factor, [&](State<double>& state) {
        carry_by_tensions(predictor, state, step.begin, step.dt, left, right);
        if (step.sure())
          state.string_state = StringState::kOnString;
        else if (TightString::around(predictor, state, step.end).excess() >
                 predictor.parameters().flying_distance)
          state.string_state = StringState::kFlying;
        return std::pair(step.read[0].tension, step.read[1].tension);
      });
}

}  // namespace diabolo
