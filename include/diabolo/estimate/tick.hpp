// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "diabolo/estimate/belief.hpp"
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
  static constexpr int kColumns = Points::kCount + kSize;  ///< deviations of points and process noise
  using Deviations = MatrixOf<kSize, kColumns>;

  /// Pulls that are this many times as surprising as expected belong to another event, such as a catch that
  /// came a step sooner.
  static constexpr double kMostSurprise = 6.0;

  void advance(Tick<kAxle>& tick) const {
    MatrixOf<kSize, Points::kCount> places;
    MatrixOf<6, Points::kCount> pulls;
    Belief<kAxle>& now = tick.after;
    now.time = tick.before.time + tick.dt;
    now.string_weights = {};
    State<double> centre;
    double pulled = 0.0;
    for (int i = 0; i < Points::kCount; ++i) {
      State<double> state = Chart::at(tick.before.state, Points::offset(tick.before.factor, i));
      keep_within_string(predictor_, state, tick.begin, tick.before.pulled);
      const State<double> start = state;
      predictor_.step(state, tick.begin, tick.end, tick.dt);
      if (i == 0) centre = state;
      places.col(i) = Chart::from(centre, state);
      const TipForces<double> forces = tip_forces(predictor_, start, state, tick.begin, tick.end, tick.dt);
      pulls.col(i) << forces.left, forces.right;
      now.string_weights[static_cast<std::size_t>(state.string_state)] += Points::weight(i);
      if (squared_norm(state.string_acceleration) > 0.0) pulled += Points::weight(i);
    }
    now.pulled = pulled > 0.5;
    now.state = Chart::at(centre, Points::deviate(places));
    now.state.string_state = static_cast<StringState>(
        std::ranges::max_element(now.string_weights) - now.string_weights.begin());
    Deviations spread;
    spread << places, noise_factor<kAxle>(noise_, tick.dt);
    now.factor = lower_factor<kSize, kColumns>(spread);
    now.surprise = 0.0;
    now.ignored = false;
    if (const auto* forces = std::get_if<ForceReading>(&tick.pulls)) feel(*forces, spread, pulls, now);
    if (const auto* tensions = std::get_if<TensionReading>(&tick.pulls)) feel(*tensions, spread, pulls, now);
  }

  void feel(const ForceReading& reading, const Deviations& spread, MatrixOf<6, Points::kCount> pulls,
            Belief<kAxle>& now) const {
    const ColumnOf<6> expected = Points::deviate(pulls);
    ColumnOf<6> read;
    read << reading.forces.left, reading.forces.right;
    MatrixOf<6> noise = MatrixOf<6>::Zero();
    noise.topLeftCorner<3, 3>() = with_share(reading.left_noise, expected.head<3>().norm());
    noise.bottomRightCorner<3, 3>() = with_share(reading.right_noise, expected.tail<3>().norm());
    correct<6>(spread, pulls, noise, read - expected, now);
  }

  void feel(const TensionReading& reading, const Deviations& spread, const MatrixOf<6, Points::kCount>& pulls,
            Belief<kAxle>& now) const {
    MatrixOf<2, Points::kCount> tensions;
    tensions << pulls.template topRows<3>().colwise().norm(), pulls.template bottomRows<3>().colwise().norm();
    const ColumnOf<2> expected = Points::deviate(tensions);
    MatrixOf<2> noise = MatrixOf<2>::Zero();
    for (int side = 0; side < 2; ++side)
      noise(side, side) = std::hypot(reading.noise, noise_.tension * expected[side]);
    correct<2>(spread, tensions, noise, ColumnOf<2>(reading.left, reading.right) - expected, now);
  }

  /// A reading's own noise and that of a tension in the model [N].
  MatrixOf<3> with_share(const MatrixOf<3>& own, double tension) const {
    MatrixOf<3, 6> both;
    both << own, noise_.tension * tension * MatrixOf<3>::Identity();
    return lower_factor<3, 6>(both);
  }

  template <int K>
  void correct(const Deviations& spread, const MatrixOf<K, Points::kCount>& deviations, const MatrixOf<K>& noise,
               const ColumnOf<K>& innovation, Belief<kAxle>& now) const {
    MatrixOf<K, kColumns> expected;
    expected << deviations, MatrixOf<K, kSize>::Zero();
    const Correction<kSize> correction = condition<kSize, K, kColumns>(spread, expected, noise, innovation);
    now.surprise = correction.surprise / K;
    now.ignored = !(now.surprise < kMostSurprise);
    if (!now.ignored) now.take(correction);
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
                                          MatrixOf<1>(look.spin_noise), ColumnOf<1>(*look.spin - now.state.spin)));
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
