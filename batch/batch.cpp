// SPDX-License-Identifier: MIT
#include "diabolo/batch/kernels.hpp"

#include <algorithm>

namespace diabolo {

namespace batch {
extern const BatchKernel baseline, avx2, avx512;
}  // namespace batch

std::vector<BatchKernel> batch_kernels() {
  const auto named = [](BatchKernel kernel, const char* name) {
    kernel.instruction_set = name;
    return kernel;
  };
  std::vector<BatchKernel> kernels{named(batch::baseline, "baseline")};
#ifdef DIABOLO_BATCH_X86
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    kernels.push_back(named(batch::avx2, "avx2"));
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    kernels.push_back(named(batch::avx512, "avx512"));
#endif
  return kernels;
}

BatchKernel best_batch_kernel() { return batch_kernels().back(); }

BatchKernel batch_kernel_for(std::size_t count) {
  const std::vector<BatchKernel> kernels = batch_kernels();
  const auto takes_all = [count](const BatchKernel& one) {
    return static_cast<std::size_t>(one.lanes) >= count;
  };
  const auto narrowest = std::find_if(kernels.begin(), kernels.end(), takes_all);
  return narrowest == kernels.end() ? kernels.back() : *narrowest;
}

}  // namespace diabolo
