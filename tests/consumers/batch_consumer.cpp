// SPDX-License-Identifier: MIT
#include <cstdio>

#include <diabolo/batch/kernels.hpp>

/// Says which instruction set the compiled kernels would use here.
int main() { std::printf("batch kernel: %s\n", diabolo::best_batch_kernel().instruction_set); }
