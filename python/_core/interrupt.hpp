// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>

namespace diabolo::python {

/// Runs `work(cancel)` on a thread of its own without the interpreter's lock. Meanwhile it calls `watch()`
/// with the lock held, some fifty times a second, and looks for Ctrl-C: then, or when `watch` throws,
/// `cancel` becomes true, the work has to come to its end, and the exception goes on. Call it with the lock
/// held.
template <class Work, class Watching>
void run_interruptibly(const Work& work, const Watching& watch) {
  std::atomic<bool> cancel = false;
  std::future<void> done = std::async(std::launch::async, [&] { work(cancel); });
  const pybind11::gil_scoped_release unlocked;
  while (done.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
    const pybind11::gil_scoped_acquire locked;
    try {
      watch();
      if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
    } catch (...) {
      cancel = true;
      const pybind11::gil_scoped_release working;  // the work may be waiting for the lock
      done.wait();
      throw;
    }
  }
  done.get();
}

template <class Work>
void run_interruptibly(const Work& work) {
  run_interruptibly(work, [] {});
}

}  // namespace diabolo::python
