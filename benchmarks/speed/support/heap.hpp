// SPDX-License-Identifier: MIT
#pragma once

namespace diabolo {

/// How often this program has asked for memory with operator new since it began.
long allocations();

}  // namespace diabolo
