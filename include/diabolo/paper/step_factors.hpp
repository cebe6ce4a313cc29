// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/parameters.hpp"

namespace diabolo {

/// Time that the factors of a step stand for [s]: the step, or the reference step of the published rules.
template <class Scalar>
Scalar factor_time(const Parameters<Scalar>& parameters, const Scalar& dt) {
  return parameters.pull.per_step ? parameters.pull.reference_step : dt;
}

/// The share of the velocity that dissipation leaves over a step, in the lanes `where`.
template <class Scalar>
[[gnu::always_inline]] inline Scalar dissipation(const Parameters<Scalar>& parameters, const Scalar& dt,
                                                 const Mask<Scalar>& where) {
  using std::exp;
  if (is_constant_zero(parameters.dissipation_rate)) return Scalar(1);
  return select(where, Scalar(exp(-parameters.dissipation_rate * factor_time(parameters, dt))), Scalar(1));
}

}  // namespace diabolo
