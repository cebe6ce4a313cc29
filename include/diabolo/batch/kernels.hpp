// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "diabolo/batch/lanes.hpp"

namespace diabolo {

/// The kernels of the compiled library `diabolo::batch` that this processor can run, the fastest last.
std::vector<BatchKernel> batch_kernels();

/// The fastest of them.
BatchKernel best_batch_kernel();

/// That which is fastest for `count` predictions: no wider than they need. All give the same bits.
BatchKernel batch_kernel_for(std::size_t count);

}  // namespace diabolo
