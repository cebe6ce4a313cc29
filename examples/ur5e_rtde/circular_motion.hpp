// SPDX-License-Identifier: MIT
#pragma once

#include "diabolo/plan/tip_path.hpp"

namespace ur5e {

/// Circular acceleration for so many seconds or a little more, round after round, each planned from where the
/// one before is predicted to end; `spin` [rad/s] at first. The model has friction between string and axle,
/// without which no motion gains spin. Throws std::invalid_argument where the duration is none.
diabolo::TipPath<double> circular_motion(double seconds, double spin = 60);

}  // namespace ur5e
