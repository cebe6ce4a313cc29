// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "diabolo/estimate/passage.hpp"

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
    if (tick.look) see(*tick.look, tick.end, tick.after);
  }

 private:
  using Points = SigmaPoints<kSize>;
  static constexpr int kPulls = Passage<kAxle>::kPulls;
  static constexpr int kColumns = Points::kCount + kSize + 2;  ///< of points and of what a step adds
  using Deviations = MatrixOf<kSize, kColumns>;

  /// A tension so many standard deviations from what the string would have is of a string that gives, and
  /// bounces; the diabolo then goes by what is measured, until so many steps had nothing of that.
  static constexpr double kStrange = 5.0;
  static constexpr int kCalm = 5;
  /// A model's error lasts, where a sensor's noise is another at each step: it counts so many times.
  static constexpr double kLasting = 4.0;
  /// A look so many deviations beyond the string's reach is of a diabolo that is off the string.
  static constexpr double kBeyond = 6.0;

  void advance(Tick<kAxle>& tick) const {
    Belief<kAxle>& now = tick.after;
    const bool reads = tick.pulls.index() != 0;
    const State<double>& from = tick.before.state;
    const PulledStep step{
        tick.begin, tick.end, tick.dt,
        strand_pulls(tick.pulls, pulling_strands(predictor_, from, from, tick.begin, tick.end))};
    Passage<kAxle> passage = pass_on_string(predictor_, step, tick.before);
    now.strange = reads && strange(passage, step.read) ? kCalm : std::max(0, tick.before.strange - 1);
    if (reads && now.strange > 0) passage = pass_by_tensions(predictor_, step, tick.before);
    now.time = tick.before.time + tick.dt;
    now.string_weights = passage.string_weights;
    now.pulled = passage.pulled > 0.5;
    now.surprise = 0.0;
    now.state = Chart::at(passage.centre, Points::deviate(passage.places));
    now.state.string_state =
        static_cast<StringState>(std::ranges::max_element(now.string_weights) - now.string_weights.begin());
    Deviations spread;
    spread << passage.places, passage_noise<kAxle>(noise_, passage, tick.end, tick.dt);
    if (reads)
      feel(step.read, spread, passage.pulls, now);
    else
      now.factor = lower_factor<kSize, kColumns>(spread);
  }

  double tension_noise(const StrandPull& read) const {
    return std::hypot(read.noise.row(0).norm(), noise_.tension * read.tension);
  }

  bool strange(const Passage<kAxle>& passage, const StrandPulls& read) const {
    MatrixOf<kPulls, Points::kCount> pulls = passage.pulls;
    const ColumnOf<kPulls> expected = Points::deviate(pulls);
    for (int side = 0; side < 2; ++side) {
      const StrandPull& one = read[static_cast<std::size_t>(side)];
      const double deviation = std::hypot(pulls.row(3 * side).norm(), tension_noise(one));
      if (std::abs(one.tension - expected[3 * side]) > kStrange * deviation) return true;
    }
    return false;
  }

  /// The noise of a strand's reading with what the model's tension and direction may be off by [N].
  MatrixOf<3> with_model(const StrandPull& read) const {
    MatrixOf<3> noise = read.noise;
    noise.row(0) *= std::hypot(1.0, kLasting * noise_.tension * read.tension / noise.row(0).norm());
    for (int across = 1; across < 3; ++across)
      noise.row(across) *=
          std::hypot(1.0, kLasting * noise_.direction * read.tension / noise.row(across).norm());
    return noise;
  }

  void feel(const StrandPulls& read, const Deviations& spread, MatrixOf<kPulls, Points::kCount> pulls,
            Belief<kAxle>& now) const {
    ColumnOf<kPulls> innovation = -Points::deviate(pulls);
    MatrixOf<kPulls> noise = MatrixOf<kPulls>::Zero();
    for (int side = 0; side < 2; ++side) {
      innovation[3 * side] += read[static_cast<std::size_t>(side)].tension;
      noise.template block<3, 3>(3 * side, 3 * side) = with_model(read[static_cast<std::size_t>(side)]);
    }
    MatrixOf<kPulls, kColumns> deviations = MatrixOf<kPulls, kColumns>::Zero();
    deviations.template leftCols<Points::kCount>() = pulls;
    const Correction<kSize> correction =
        condition<kSize, kPulls, kColumns>(spread, deviations, noise, innovation);
    now.surprise = correction.surprise / kPulls;
    now.take(correction);
  }

  /// The diabolo goes on as it is from the tick to the look.
  void see(const CameraLook& look, const Tips<double>& tips, Belief<kAxle>& now) const {
    State<double> seen = now.state;
    seen.position = look.position;
    if (TightString::around(predictor_, seen, tips).excess() > 2.0 * kBeyond * look.noise) fly(now);
    const double later = look.time - now.time;
    MatrixOf<3, kSize> place = now.factor.template middleRows<3>(Chart::kPosition);
    place += later * now.factor.template middleRows<3>(Chart::kVelocity);
    const Vector3<double> expected = now.state.position + now.state.velocity * later;
    now.take(condition<kSize, 3, kSize>(now.factor, place, look.noise * MatrixOf<3>::Identity(),
                                        look.position - expected));
    if (look.spin)
      now.take(condition<kSize, 1, kSize>(now.factor, now.factor.row(Chart::kSpin),
                                          MatrixOf<1>(look.spin_noise),
                                          ColumnOf<1>(*look.spin - now.state.spin)));
    if constexpr (kAxle)
      if (look.axle) {
        seen = now.state;
        seen.axis = look.axle->dot(now.state.axis) < 0.0 ? Vector3<double>(-*look.axle) : *look.axle;
        const ColumnOf<2> off = Chart::from(now.state, seen).template tail<2>();
        now.take(condition<kSize, 2, kSize>(now.factor, now.factor.template bottomRows<2>(),
                                            look.axle_noise * MatrixOf<2>::Identity(), off));
      }
  }

  static void fly(Belief<kAxle>& now) {
    now.state.string_state = StringState::kFlying;
    now.string_weights = {0.0, 0.0, 1.0};
  }

  Predictor<double, Effects...> predictor_;
  ProcessNoise noise_;
};

}  // namespace diabolo
