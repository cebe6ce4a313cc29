// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/estimate/belief.hpp"
#include "diabolo/estimate/within_string.hpp"

namespace diabolo {

/// Updates a belief by a camera's measurement; the diabolo goes on as it is from the belief's time, which is
/// that of the tips, to that of the measurement. One that is seen far beyond the string's reach is off the
/// string.
template <bool kAxle, template <class> class... Effects>
void camera_update(const Predictor<double, Effects...>& predictor, const CameraMeasurement& measured,
                   const Tips<double>& tips, Belief<kAxle>& now) {
  using Chart = StateChart<kAxle>;
  constexpr double kBeyond = 6.0;  // standard deviations
  constexpr int kSize = Chart::kSize;
  State<double> seen = now.state;
  seen.position = measured.position;
  if (TightString::around(predictor, seen, tips).excess() > 2.0 * kBeyond * measured.noise) {
    now.state.string_state = StringState::kFlying;
    now.string_weights = {0.0, 0.0, 1.0};
  }
  const double later = measured.time - now.time;
  MatrixOf<3, kSize> place = now.factor.template middleRows<3>(Chart::kPosition);
  place += later * now.factor.template middleRows<3>(Chart::kVelocity);
  const Vector3<double> expected = now.state.position + now.state.velocity * later;
  now.update(condition<kSize, 3, kSize>(now.factor, place, measured.noise * MatrixOf<3>::Identity(),
                                        measured.position - expected));
  if (measured.spin)
    now.update(condition<kSize, 1, kSize>(now.factor, now.factor.row(Chart::kSpin),
                                          MatrixOf<1>(measured.spin_noise),
                                          ColumnOf<1>(*measured.spin - now.state.spin)));
  if constexpr (kAxle)
    if (measured.axle) {
      seen = now.state;
      seen.axis =
          measured.axle->dot(now.state.axis) < 0.0 ? Vector3<double>(-*measured.axle) : *measured.axle;
      const ColumnOf<2> off = Chart::from(now.state, seen).template tail<2>();
      now.update(condition<kSize, 2, kSize>(now.factor, now.factor.template bottomRows<2>(),
                                            measured.axle_noise * MatrixOf<2>::Identity(), off));
    }
}

}  // namespace diabolo
