// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include "diabolo/diagnose/unknowns.hpp"
#include "diabolo/evaluate/start_on_spring.hpp"

namespace diabolo::diagnose_detail {

/// Softer than this [m/N] the string's own oscillation is slow enough for the step of a diagnosis; a stiffer
/// one follows its tension at once (see string_shift), and only its mean stretch can be seen.
inline constexpr double kSoftString = 1e-4;

/// Between kSoftString and this [m/N] a step is kFiner times shorter, so that no string turns by more than
/// half a radian in it (0.25 kg, rows of 4.2 ms: 370 rad/s at 1e-4, 120 rad/s at 1e-3).
inline constexpr double kSlowString = 1e-3;
inline constexpr int kFiner = 3;

/// What a fit adds to it.
inline double added_give(const UnknownVector& at) {
  return at[index_of(Unknown::kCompliance)] + 2.0 * at[index_of(Unknown::kStickCompliance)];
}

/// Whether a string that gives so much [m/N] oscillates in a simulation of a diagnosis.
inline bool is_dynamic(double give) { return give > kSoftString; }

/// How many steps stand in place of a usual one.
inline int steps_for_spring(double give) { return is_dynamic(give) && give < kSlowString ? kFiner : 1; }

/// What oscillates loses in each radian at least this share of what it stores (loss factor): nylon and
/// polyester do in bulk, a braid and a stick in a hand more (Ashby, Materials Selection in Mechanical
/// Design). Without it a string may ring for ever and stand for whatever makes a catch bounce.
inline constexpr double kLeastLoss = 0.01;

/// The damping [N s/m] beside a spring on which the diabolo oscillates with that loss: c = loss / (give
/// omega), where omega^2 = p^2 / (mass give) and the path grows by p = 1.5 for each metre that the diabolo
/// falls. A spring that follows its tension at once shows none.
inline double least_damping(double give) {
  constexpr double kUsualMass = 0.2, kUsualPath = 1.5;
  return is_dynamic(give) ? kLeastLoss / kUsualPath * std::sqrt(kUsualMass / give) : 0.0;
}

/// The least values that unknowns may have where they are at `at`. What a spring of the base loses counts for
/// what gives beside it (see prepared() for `centre`).
inline UnknownVector least_values(const UnknownVector& at, const UnknownVector& centre) {
  UnknownVector least;
  for (int u = 0; u < kUnknowns; ++u) least[u] = kUnknownInfos[static_cast<std::size_t>(u)].minimum;
  if (centre[index_of(Unknown::kDamping)] > 0.0)
    least[index_of(Unknown::kDamping)] = least_damping(at[index_of(Unknown::kCompliance)]);
  if (centre[index_of(Unknown::kTipMass)] > 0.0)  // two sticks in a row
    least[index_of(Unknown::kStickDamping)] =
        2.0 * least_damping(2.0 * at[index_of(Unknown::kStickCompliance)]);
  return least;
}

/// Whether a bounce on a string that gives so much [m/N] is so slow and wide that a window's start shows it.
inline bool is_bouncy(double give) { return give > kBouncyString; }

}  // namespace diabolo::diagnose_detail
