// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/estimate/belief.hpp"
#include "diabolo/estimate/within_string.hpp"

namespace diabolo {

/// Corrects a belief by a look of a camera; the diabolo goes on as it is from the belief's time, which is
/// that of the tips, to the look. One that is seen far beyond the string's reach is off the string.
template <bool kAxle, template <class> class... Effects>
void take_look(const Predictor<double, Effects...>& predictor, const CameraLook& look,
               const Tips<double>& tips, Belief<kAxle>& now) {
  using Chart = StateChart<kAxle>;
  constexpr double kBeyond = 6.0;  // standard deviations
  constexpr int kSize = Chart::kSize;
  State<double> seen = now.state;
  seen.position = look.position;
  if (TightString::around(predictor, seen, tips).excess() > 2.0 * kBeyond * look.noise) {
    now.state.string_state = StringState::kFlying;
    now.string_weights = {0.0, 0.0, 1.0};
  }
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

}  // namespace diabolo
