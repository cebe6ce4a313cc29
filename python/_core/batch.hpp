// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#include "diabolo/batch/batch.hpp"

namespace diabolo::python {

/// Runs a batch with the fastest kernel of this processor; see rollout_batch().
BatchResult run_batch(const Batch& batch, int threads, const std::atomic<bool>& cancel);

}  // namespace diabolo::python
