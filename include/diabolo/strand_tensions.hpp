// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "diabolo/predictor.hpp"
#include "diabolo/string/strands.hpp"

namespace diabolo {

/// What the string gave the diabolo in a step that the predictor made, friction too [m/s^2]: its mean
/// acceleration less gravity and what other effects push.
template <class Scalar, template <class> class... Effects>
Vector3<Scalar> string_pull(const Predictor<Scalar, Effects...>& predictor, const State<Scalar>& before,
                            const State<Scalar>& after, const Tips<Scalar>& begin, const Scalar& dt) {
  return (after.velocity - before.velocity) * Scalar(Scalar(1) / dt) -
         predictor.effects().acceleration(before, begin, dt, predictor.parameters());
}

/// The strands that pulled in such a step: from where effects let them begin, such as at a bent stick.
template <class Scalar, template <class> class... Effects>
Strands<Scalar> pulling_strands(const Predictor<Scalar, Effects...>& predictor, const State<Scalar>& before,
                                const State<Scalar>& after, Tips<Scalar> begin, Tips<Scalar> end) {
  if constexpr (EffectSet<Scalar, Effects...>::kChangesTips)
    if (predictor.effects().moves_tips()) {
      const TipShift<Scalar> shift = predictor.effects().tip_shift(before, begin, predictor.parameters());
      shift.move(begin);
      shift.move(end);
    }
  return Strands<Scalar>::halfway(before, after, begin, end);
}

namespace string_detail {

template <class Scalar, template <class> class... Effects>
std::pair<Scalar, Scalar> taut_tensions(const Predictor<Scalar, Effects...>& predictor,
                                        const Strands<Scalar>& strands, const State<Scalar>& before,
                                        const State<Scalar>& after, const Tips<Scalar>& begin,
                                        const Scalar& dt) {
  const Mask<Scalar> taut = is(after.string_state, StringState::kOnString);
  const auto [left, right] =
      strands.tensions(string_pull(predictor, before, after, begin, dt) * predictor.parameters().mass);
  return {select(taut, left, Scalar(0)), select(taut, right, Scalar(0))};
}

}  // namespace string_detail

/// Mean tensions of the left and the right strand over a step that the predictor made [N], for the diabolo's
/// mass in its parameters; zero where the string is slack at the end. While the string slips over the axle
/// they are as exp(c b), c the friction and b the angle around the axle.
template <class Scalar, template <class> class... Effects>
std::pair<Scalar, Scalar> strand_tensions(const Predictor<Scalar, Effects...>& predictor,
                                          const State<Scalar>& before, const State<Scalar>& after,
                                          const Tips<Scalar>& begin, const Tips<Scalar>& end,
                                          const Scalar& dt) {
  return string_detail::taut_tensions(predictor, pulling_strands(predictor, before, after, begin, end),
                                      before, after, begin, dt);
}

/// What the string does to the two tips [N], world frame: each is pulled along its strand.
template <class Scalar>
struct TipForces {
  Vector3<Scalar> left = Vector3<Scalar>::Constant(Scalar(0)), right = Vector3<Scalar>::Constant(Scalar(0));
};

/// Mean forces of the string on the tips over a step that the predictor made: its strand_tensions() along the
/// strands.
template <class Scalar, template <class> class... Effects>
TipForces<Scalar> tip_forces(const Predictor<Scalar, Effects...>& predictor, const State<Scalar>& before,
                             const State<Scalar>& after, const Tips<Scalar>& begin, const Tips<Scalar>& end,
                             const Scalar& dt) {
  const Strands<Scalar> strands = pulling_strands(predictor, before, after, begin, end);
  const auto [left, right] = string_detail::taut_tensions(predictor, strands, before, after, begin, dt);
  return {strands.left * Scalar(-left), strands.right * Scalar(-right)};
}

}  // namespace diabolo
