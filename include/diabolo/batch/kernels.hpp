// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "diabolo/batch/lanes.hpp"

namespace diabolo {

/// The kernels of the compiled library `diabolo::batch` that this processor can run, the fastest last.
std::vector<BatchKernel> batch_kernels();

/// The fastest of them.
BatchKernel best_batch_kernel();

}  // namespace diabolo
