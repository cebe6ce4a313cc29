// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/diagnose/unknowns.hpp"
#include "diabolo/effects/stick_flex.hpp"
#include "diabolo/effects/string_elasticity.hpp"

namespace diabolo::diagnose_detail {

/// Softer than this [m/N] the string's own oscillation is slow enough for the step of a diagnosis; a stiffer
/// one follows its tension at once (see string_shift), and only its mean stretch can be seen.
inline constexpr double kSoftString = 1e-4;

/// Between kSoftString and this [m/N] a step is kFiner times shorter, so that no string turns by more than
/// half a radian in it (0.25 kg, rows of 4.2 ms: 370 rad/s at 1e-4, 120 rad/s at 1e-3).
inline constexpr double kSlowString = 1e-3;
inline constexpr int kFiner = 3;

/// How far the string gives under a tension, in itself and at both tips [m/N].
template <class Effects>
double give_of(const Effects& effects) {
  return value_of(effects.template get<StringElasticity>().compliance_per_newton) +
         2.0 * value_of(effects.template get<StickFlex>().compliance);
}

/// What a fit adds to it.
inline double added_give(const UnknownVector& at) {
  return at[index_of(Unknown::kCompliance)] + 2.0 * at[index_of(Unknown::kStickCompliance)];
}

/// Whether a string that gives so much [m/N] oscillates in a simulation of a diagnosis.
inline bool is_dynamic(double give) { return give > kSoftString; }

/// How many steps stand in place of a usual one.
inline int steps_for_spring(double give) { return is_dynamic(give) && give < kSlowString ? kFiner : 1; }

/// From such springs on [m/N] a bounce is so slow and wide that a window's start shows it. (On stiffer ones
/// it drowns in the noise, and a start is better at rest.)
inline constexpr double kBouncyString = 0.012;

inline bool is_bouncy(const UnknownVector& at) { return added_give(at) > kBouncyString; }

}  // namespace diabolo::diagnose_detail
