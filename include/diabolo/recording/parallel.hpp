// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <stdexcept>
#include <thread>

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

/// Calls `work(i)` for every i below `count`, each once and in no certain order, by the calling thread and,
/// where `threads` is 2, one more. The calls must not depend on each other. The first exception of either
/// thread, or of the watch, ends the work and reaches the caller.
template <class Work>
void for_each_index(std::size_t count, int threads, const Watch& watch, const Work& work) {
  constexpr std::size_t kLooks = 200;  // at the watch, at most
  std::atomic<std::size_t> next{0}, done{0};
  std::exception_ptr failure;
  const auto take = [&] {
    const std::size_t i = next.fetch_add(1);
    if (i >= count) return false;
    work(i);
    done.fetch_add(1);
    return true;
  };
  const auto stop = [&] { next.store(count); };
  const auto look = [&] {
    if (watch.cancelled && watch.cancelled()) throw Cancelled();
    if (watch.progress)
      watch.progress(count == 0 ? 1.0 : static_cast<double>(done.load()) / static_cast<double>(count));
  };
  const auto help = [&] {
    try {
      while (take()) {
      }
    } catch (...) {
      failure = std::current_exception();
      stop();
    }
  };
  {
    std::jthread helper;
    try {
      look();
      if (threads >= 2 && count > 1) helper = std::jthread(help);
      for (std::size_t seen = 0; take();) {
        if (done.load() - seen < std::max<std::size_t>(1, count / kLooks)) continue;
        seen = done.load();
        look();
      }
    } catch (...) {
      stop();
      throw;
    }
  }
  if (failure) std::rethrow_exception(failure);
  look();
}

}  // namespace diabolo
