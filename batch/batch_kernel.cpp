// SPDX-License-Identifier: MIT
#include "diabolo/batch/lanes.hpp"

namespace {

// Compiled once per instruction set. A tag without linkage keeps every instance of a template in this object
// file.
struct Isa {};

#if defined(__AVX512F__)
constexpr int kLanes = 8;
#elif defined(__AVX2__)
constexpr int kLanes = 4;
#else
constexpr int kLanes = 2;
#endif

void run(const diabolo::LaneBlock& block) {
  diabolo::run_lanes<diabolo::Pack<double, kLanes, Isa>>(block);
#if defined(__AVX__)
  __builtin_ia32_vzeroupper();  // The compiler may leave it out; code of others then runs at half speed.
#endif
}

}  // namespace

namespace diabolo::batch {

extern const BatchKernel DIABOLO_BATCH_ISA;
const BatchKernel DIABOLO_BATCH_ISA{kLanes, &run, ""};

}  // namespace diabolo::batch
