// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>

namespace diabolo::python {

/// Runs `work(cancel)` on a thread of its own without the interpreter's lock, and looks for Ctrl-C meanwhile:
/// then `cancel` becomes true, the work has to come to its end, and KeyboardInterrupt is raised. Call it with
/// the lock held.
template <class Work>
void run_interruptibly(const Work& work) {
  std::atomic<bool> cancel = false;
  std::future<void> done = std::async(std::launch::async, [&] { work(cancel); });
  const pybind11::gil_scoped_release unlocked;
  while (done.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
    const pybind11::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() == 0) continue;
    cancel = true;
    done.wait();
    throw pybind11::error_already_set();
  }
  done.get();
}

}  // namespace diabolo::python
