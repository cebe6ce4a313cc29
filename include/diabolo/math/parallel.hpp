// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

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

/// How many threads `wanted` means: 0 one for every processor, else itself.
inline std::size_t thread_count(int wanted) {
  return wanted > 0 ? static_cast<std::size_t>(wanted) : std::max(1U, std::thread::hardware_concurrency());
}

/// Throws std::invalid_argument where `threads` is below zero.
inline void check_threads(int threads) {
  if (threads < 0)
    throw std::invalid_argument("threads: " + std::to_string(threads) +
                                "; must be 0 (one for every processor) or more");
}

/// Calls `work(i)` for every i below `count`, each once and in no certain order, by the calling thread and
/// thread_count(threads) - 1 more. The calls must not depend on each other; then neither does what they give
/// on the number of threads. The first exception of any thread, or of the watch, ends the work and reaches
/// the caller.
template <class Work>
void for_each_index(std::size_t count, int threads, const Watch& watch, const Work& work) {
  constexpr std::size_t kLooks = 200;  // at the watch, at most
  std::atomic<std::size_t> next{0}, done{0};
  std::atomic<bool> failed{false};
  std::exception_ptr failure;  ///< of a helper, the first one
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
      if (!failed.exchange(true)) failure = std::current_exception();
      stop();
    }
  };
  {
    std::vector<std::jthread> helpers;
    try {
      look();
      for (std::size_t i = 1; i < std::min(thread_count(threads), count); ++i) helpers.emplace_back(help);
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
