// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/paper/step_factors.hpp"
#include "diabolo/string/slip.hpp"

namespace diabolo {

/// The paper's spin update (its equation of the rotation speed): w += mu * (change of the distance to the
/// right tip), with mu_acceleration while that strand grows and mu_deceleration otherwise. Unbounded: it
/// knows no slip.
template <class Scalar>
Scalar spin_after_length_change(const Scalar& spin, const Scalar& length_change,
                                const Parameters<Scalar>& parameters) {
  return spin + length_change * select(length_change > Scalar(0), parameters.pull.mu_acceleration,
                                       parameters.pull.mu_deceleration);
}

/// The published program's axle slip, stated as a rate: r dw/dt = k (u - r w) with u the speed of the string
/// over the axle [m/s]. `duration` [s] is the step, or the reference step for the per-step rule; explicit as
/// published.
template <class Scalar>
Scalar spin_after_slip_explicit(const Scalar& spin, const Scalar& string_speed, const Scalar& duration,
                                const Parameters<Scalar>& parameters) {
  const Scalar& r = parameters.axle_radius;
  return spin + (string_speed - spin * r) * parameters.spin_coupling * duration / r;
}

/// The spin rule of a pull-velocity model, after a step in which the distance to the right tip has changed by
/// `length_change` [m].
template <class Scalar>
Scalar spin_after_passing(const Scalar& spin, const Scalar& length_change, const Scalar& dt,
                          const Parameters<Scalar>& parameters) {
  if (parameters.pull.spin_rule == SpinRule::kLengthChange)
    return spin_after_length_change(spin, length_change, parameters);
  const Scalar speed = length_change / dt, duration = factor_time(parameters, dt);
  return parameters.pull.per_step ? spin_after_slip_explicit(spin, speed, duration, parameters)
                                  : spin_after_slip(spin, speed, duration, parameters);
}

}  // namespace diabolo
