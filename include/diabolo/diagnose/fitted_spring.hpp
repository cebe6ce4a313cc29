// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/diagnose/unknowns.hpp"

namespace diabolo::diagnose_detail {

/// Softer than this [m/N] the string's own oscillation is slow enough for the step of a diagnosis; a stiffer
/// one follows its tension at once (see string_shift), and only its mean stretch can be seen.
inline constexpr double kSoftString = 1e-4;

/// Softer than this [m/N] it is slow enough for the usual step; between, for one of kFiner in its place. (A
/// diabolo of 0.25 kg then oscillates at 120 and 370 rad/s: half a radian in a step.)
inline constexpr double kSlowString = 1e-3;
inline constexpr int kFiner = 3;

inline double compliance_of(const UnknownVector& at) {
  return at[index_of(Unknown::kCompliance)] + 2.0 * at[index_of(Unknown::kStickCompliance)];
}

inline bool dynamic_spring(const UnknownVector& at) { return compliance_of(at) > kSoftString; }

/// In place of one of the usual steps.
inline int steps_for_spring(const UnknownVector& at) {
  return dynamic_spring(at) && compliance_of(at) < kSlowString ? kFiner : 1;
}

/// From such springs on [m/N] a bounce is so slow and wide that a window's start shows it. (On stiffer ones
/// it drowns in the noise, and a start is better at rest.)
inline constexpr double kBouncyString = 0.012;

inline bool is_bouncy(const UnknownVector& at) { return compliance_of(at) > kBouncyString; }

}  // namespace diabolo::diagnose_detail
