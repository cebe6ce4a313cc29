// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <stdexcept>

namespace diabolo {

/// How long work is watched and stopped. Both functions may be empty; they are called by the thread that
/// started the work, and by no other. An exception from them ends the work and reaches the caller.
struct Watch {
  std::function<void(double)> progress;  ///< the fraction done, from 0 to 1
  std::function<bool()> cancelled;       ///< true ends the work with Cancelled
};

/// Work was ended by Watch::cancelled.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace diabolo
