// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "diabolo/estimate/belief.hpp"
#include "diabolo/estimate/carried.hpp"
#include "diabolo/estimate/pulls.hpp"

namespace diabolo {

/// Where a step takes the sigma points of a belief, and the pulls that each would have shown:
/// StrandPull::expected() of the left strand over that of the right one.
template <bool kAxle>
struct Passage {
  using Chart = StateChart<kAxle>;
  using Points = SigmaPoints<Chart::kSize>;
  static constexpr int kPulls = 6;

  State<double> centre;  ///< of the first point
  MatrixOf<Chart::kSize, Points::kCount> places;
  MatrixOf<kPulls, Points::kCount> pulls;
  std::array<double, 3> string_weights{};
  double pulled = 0.0;  ///< weight of the points at which the string pulled
};

/// A step of the tips, and what was read of the strands.
struct PulledStep {
  const Tips<double>&begin, &end;
  double dt;  ///< [s]
  StrandPulls read;

  bool sure() const { return read[0].sure && read[1].sure; }
};

namespace estimate_detail {

/// `move(state)` makes the step and gives the strands' tensions.
template <bool kAxle, template <class> class... Effects, class Move>
Passage<kAxle> passage(const Predictor<double, Effects...>& predictor, const PulledStep& step,
                       const State<double>& from, const MatrixOf<StateChart<kAxle>::kSize>& factor,
                       const Move& move) {
  using Points = typename Passage<kAxle>::Points;
  const StrandPulls& read = step.read;
  Passage<kAxle> result;
  for (int i = 0; i < Points::kCount; ++i) {
    State<double> state = StateChart<kAxle>::at(from, Points::offset(factor, i));
    const State<double> start = state;
    const auto [left, right] = move(state);
    const Strands<double> strands = pulling_strands(predictor, start, state, step.begin, step.end);
    if (step.sure())
      state.spin = spin_by_tensions(predictor, start, state, step.begin, step.end, step.dt, read[0].tension,
                                    read[1].tension);
    if (i == 0) result.centre = state;
    result.places.col(i) = StateChart<kAxle>::from(result.centre, state);
    result.pulls.col(i) << read[0].expected(left, strands.left), read[1].expected(right, strands.right);
    result.string_weights[static_cast<std::size_t>(state.string_state)] += Points::weight(i);
    if (squared_norm(state.string_acceleration) > 0.0) result.pulled += Points::weight(i);
  }
  return result;
}

}  // namespace estimate_detail

}  // namespace diabolo
