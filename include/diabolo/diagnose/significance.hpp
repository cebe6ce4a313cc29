// SPDX-License-Identifier: MIT
#pragma once

namespace diabolo {

/// What stands out by so many standard deviations is there, whatever it is.
inline constexpr double kStrong = 10.0;

/// An effect stays in the model above so many standard deviations: with a score of candidates about 1e-3 of
/// recordings without any effect would show one. A fault needs more: what the model does not know ends up in
/// the nuisances.
inline constexpr double kSignificance = 4.0, kSignificanceOfFault = 5.0;

/// Beyond so many standard deviations lie 5 % of a normal variable.
inline constexpr double kNormal95 = 1.6448536269514722;

/// The base's numerical rules count beyond this share of what is left over.
inline constexpr double kNumericalShare = 0.1;

}  // namespace diabolo
