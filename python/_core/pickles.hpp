// SPDX-License-Identifier: MIT
#pragma once

namespace diabolo::python {

/// Copies and pickles of goals, limits, motions, calibrations and arms, whose classes are bound already.
void bind_pickles();

}  // namespace diabolo::python
