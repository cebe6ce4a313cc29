// SPDX-License-Identifier: MIT
#include "batch.hpp"

#include "diabolo/batch/kernels.hpp"

namespace diabolo::python {

BatchResult run_batch(const Batch& batch, int threads, const std::atomic<bool>& cancel) {
  return rollout_batch(batch, best_batch_kernel(), threads, cancel);
}

}  // namespace diabolo::python
