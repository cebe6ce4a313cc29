// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "diabolo/estimate/belief.hpp"
#include "diabolo/estimate/carried.hpp"
#include "diabolo/estimate/pulls.hpp"
#include "diabolo/estimate/within_string.hpp"

namespace diabolo {

/// A step of an estimator: from what, how the tips moved, and all that was measured of its end.
template <bool kAxle>
struct Tick {
  Belief<kAxle> before, after;
  Tips<double> begin, end;
  double dt = 0.0;  ///< [s]; zero: no step, what was known at the beginning
  PullReading pulls;
  std::optional<CameraLook> look = std::nullopt;
};

/// What predictor and measurements make of a tick.
template <bool kAxle, template <class> class... Effects>
class TickFilter {
 public:
  using Chart = StateChart<kAxle>;
  static constexpr int kSize = Chart::kSize;

  TickFilter(const Predictor<double, Effects...>& predictor, const ProcessNoise& noise)
      : predictor_(predictor), noise_(noise) {
    noise.validate();
  }

  const Predictor<double, Effects...>& predictor() const { return predictor_; }

  /// From `before` to `after`: a step, then pulls, then the look. The result does not depend on when these
  /// became known. Never allocates.
  void run(Tick<kAxle>& tick) const {
    tick.after = tick.before;
    if (tick.dt > 0.0) advance(tick);
    if (tick.look) see(*tick.look, tick.after);
  }

 private:
  using Points = SigmaPoints<kSize>;
  static constexpr int kColumns = Points::kCount + kSize + 1;  ///< deviations of points, process and string

  /// A tension so many standard deviations from what the string would have is of a string that gives, and
  /// bounces; the diabolo then goes by what is measured, until so many steps had nothing of that.
  static constexpr double kStrange = 5.0;
  static constexpr int kCalm = 5;

  /// Where the points go, and the pulls that this would have shown: each strand's StrandPull::expected().
  struct Passage {
    State<double> centre;
    MatrixOf<kSize, Points::kCount> places;
    MatrixOf<6, Points::kCount> pulls;
    std::array<double, 3> string_weights{};
    double pulled = 0.0;  ///< weight of the points at which the string pulled
  };

  void advance(Tick<kAxle>& tick) const {
    Belief<kAxle>& now = tick.after;
    const bool reads = tick.pulls.index() != 0;
    const State<double>& from = tick.before.state;
    const StrandPulls read =
        strand_pulls(tick.pulls, pulling_strands(predictor_, from, from, tick.begin, tick.end));
    Passage passage = by_string(tick, read);
    now.strange = reads && strange(passage, read) ? kCalm : std::max(0, tick.before.strange - 1);
    if (reads && now.strange > 0) passage = by_tensions(tick, read);
    now.time = tick.before.time + tick.dt;
    now.string_weights = passage.string_weights;
    now.pulled = passage.pulled > 0.5;
    now.state = Chart::at(passage.centre, Points::deviate(passage.places));
    now.state.string_state = static_cast<StringState>(
        std::ranges::max_element(now.string_weights) - now.string_weights.begin());
    MatrixOf<kSize, kColumns> spread;
    spread << passage.places, noise_factor<kAxle>(noise_, tick.dt), off_string(now.state, tick.end, passage);
    if (reads)
      feel(read, spread, passage.pulls, now);
    else
      now.factor = lower_factor<kSize, kColumns>(spread);
  }

  /// The predictor's steps.
  Passage by_string(const Tick<kAxle>& tick, const StrandPulls& read) const {
    State<double> from = tick.before.state;
    if (read[0].sure && read[1].sure)  // the string is under it
      assign_where(is(from.string_state, StringState::kFlying), from.string_state, StringState::kLoose);
    return passage(tick, from, read, [&](State<double>& state) {
      keep_within_string(predictor_, state, tick.begin, tick.before.pulled);
      const State<double> start = state;
      predictor_.step(state, tick.begin, tick.end, tick.dt);
      return strand_tensions(predictor_, start, state, tick.begin, tick.end, tick.dt);
    });
  }

  /// Steps by what is measured, which says nothing of the tensions then.
  Passage by_tensions(const Tick<kAxle>& tick, const StrandPulls& read) const {
    const bool pulls = read[0].sure && read[1].sure;
    return passage(tick, tick.before.state, read, [&](State<double>& state) {
      carry_by_tensions(predictor_, state, tick.begin, tick.dt, pulls ? read[0].tension : 0.0,
                        pulls ? read[1].tension : 0.0);
      if (pulls) state.string_state = StringState::kOnString;
      return std::pair(read[0].tension, read[1].tension);
    });
  }

  template <class Step>
  Passage passage(const Tick<kAxle>& tick, const State<double>& from, const StrandPulls& read,
                  const Step& step) const {
    Passage result;
    for (int i = 0; i < Points::kCount; ++i) {
      State<double> state = Chart::at(from, Points::offset(tick.before.factor, i));
      const State<double> start = state;
      const auto [left, right] = step(state);
      if (i == 0) result.centre = state;
      const Strands<double> strands = pulling_strands(predictor_, start, state, tick.begin, tick.end);
      if (read[0].sure && read[1].sure)
        state.spin = spin_by_tensions(predictor_, start, state, tick.begin, tick.end, tick.dt, read[0].tension,
                                      read[1].tension);
      result.places.col(i) = Chart::from(result.centre, state);
      result.pulls.col(i) << read[0].expected(left, strands.left), read[1].expected(right, strands.right);
      result.string_weights[static_cast<std::size_t>(state.string_state)] += Points::weight(i);
      if (squared_norm(state.string_acceleration) > 0.0) result.pulled += Points::weight(i);
    }
    return result;
  }

  /// How far a string of another length would have it off, to all points alike.
  ColumnOf<kSize> off_string(const State<double>& state, const Tips<double>& tips,
                             const Passage& passage) const {
    ColumnOf<kSize> deviation = ColumnOf<kSize>::Zero();
    const Vector3<double> gradient = StringPath<double>(state.position, tips).gradient();
    if (passage.pulled > 0.5)
      deviation.template head<3>() = gradient * (noise_.string_length / std::max(0.1, gradient.squaredNorm()));
    return deviation;
  }

  double tension_noise(const StrandPull& read) const {
    return std::hypot(read.noise.row(0).norm(), noise_.tension * read.tension);
  }

  bool strange(const Passage& passage, const StrandPulls& read) const {
    MatrixOf<6, Points::kCount> pulls = passage.pulls;
    const ColumnOf<6> expected = Points::deviate(pulls);
    for (int side = 0; side < 2; ++side) {
      const StrandPull& one = read[static_cast<std::size_t>(side)];
      const double deviation = std::hypot(pulls.row(3 * side).norm(), tension_noise(one));
      if (std::abs(one.tension - expected[3 * side]) > kStrange * deviation) return true;
    }
    return false;
  }

  void feel(const StrandPulls& read, const MatrixOf<kSize, kColumns>& spread,
            MatrixOf<6, Points::kCount> pulls, Belief<kAxle>& now) const {
    const ColumnOf<6> expected = Points::deviate(pulls);
    ColumnOf<6> innovation = -expected;
    MatrixOf<6> noise = MatrixOf<6>::Zero();
    for (int side = 0; side < 2; ++side) {
      const StrandPull& one = read[static_cast<std::size_t>(side)];
      innovation[3 * side] += one.tension;
      noise.block<3, 3>(3 * side, 3 * side) = one.noise;
      noise.block<1, 3>(3 * side, 3 * side) *= tension_noise(one) / one.noise.row(0).norm();
    }
    MatrixOf<6, kColumns> deviations;
    deviations << pulls, MatrixOf<6, kSize + 1>::Zero();
    const Correction<kSize> correction = condition<kSize, 6, kColumns>(spread, deviations, noise, innovation);
    now.surprise = correction.surprise / 6.0;
    now.take(correction);
  }

  /// The diabolo goes on as it is from the tick to the look.
  static void see(const CameraLook& look, Belief<kAxle>& now) {
    const double later = look.time - now.time;
    MatrixOf<3, kSize> seen = now.factor.template middleRows<3>(Chart::kPosition);
    seen += later * now.factor.template middleRows<3>(Chart::kVelocity);
    const Vector3<double> expected = now.state.position + now.state.velocity * later;
    now.take(condition<kSize, 3, kSize>(now.factor, seen, look.noise * MatrixOf<3>::Identity(),
                                        look.position - expected));
    if (look.spin)
      now.take(condition<kSize, 1, kSize>(now.factor, now.factor.row(Chart::kSpin),
                                          MatrixOf<1>(look.spin_noise),
                                          ColumnOf<1>(*look.spin - now.state.spin)));
    if constexpr (kAxle)
      if (look.axle) {
        State<double> turned = now.state;
        turned.axis = *look.axle;
        const ColumnOf<2> off = Chart::from(now.state, turned).template tail<2>();
        now.take(condition<kSize, 2, kSize>(now.factor, now.factor.template bottomRows<2>(),
                                            look.axle_noise * MatrixOf<2>::Identity(), off));
      }
  }

  Predictor<double, Effects...> predictor_;
  ProcessNoise noise_;
};

}  // namespace diabolo
