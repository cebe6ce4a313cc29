// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/effects/air.hpp"
#include "diabolo/effects/finite_axle.hpp"
#include "diabolo/effects/formula_laws.hpp"
#include "diabolo/effects/gravity_tilt.hpp"
#include "diabolo/effects/groove.hpp"
#include "diabolo/effects/gyroscopic_tilt.hpp"
#include "diabolo/effects/landing_restitution.hpp"
#include "diabolo/effects/magnus_lift.hpp"
#include "diabolo/effects/residual_force.hpp"
#include "diabolo/effects/spin_loss.hpp"
#include "diabolo/effects/stick_flex.hpp"
#include "diabolo/effects/string_elasticity.hpp"
#include "diabolo/effects/string_friction.hpp"
#include "diabolo/effects/string_mass.hpp"
#include "diabolo/effects/unbalance.hpp"
#include "diabolo/effects/unnamed_force.hpp"

namespace diabolo {

/// Every effect on place and spin, and others. (A Groove acts on the axle, too.)
template <class Scalar, template <class> class... Others>
using MotionEffects = EffectSet<Scalar, StringElasticity, StringFriction, Air, MagnusLift, SpinLoss,
                                GravityTilt, FiniteAxle, Groove, StickFlex, StringMass, LandingRestitution,
                                UnnamedForce, FormulaLaws, ResidualForce, Others...>;

/// Every effect of the library.
template <class Scalar>
using AllEffects = MotionEffects<Scalar, GyroscopicTilt, Unbalance>;

/// Whether two sets have the same laws by formulas and the same residual, whatever their numbers, as rollouts
/// side by side must.
template <class Scalar>
bool same_texts(const AllEffects<Scalar>& a, const AllEffects<Scalar>& b) {
  return same_laws(a.template get<FormulaLaws>(), b.template get<FormulaLaws>()) &&
         same_residual(a.template get<ResidualForce>(), b.template get<ResidualForce>());
}

}  // namespace diabolo
