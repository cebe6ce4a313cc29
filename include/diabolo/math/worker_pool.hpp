// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

#include "diabolo/math/parallel.hpp"

namespace diabolo {

/// Threads that wait for the next piece of work, for work too short to start threads for: some ten
/// microseconds. They begin with the first piece.
class WorkerPool {
 public:
  /// `threads`: with the caller's; 0: one for every processor. Throws std::invalid_argument below zero.
  explicit WorkerPool(int threads) : threads_((check_threads(threads), thread_count(threads))) {}
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool() {
    work_ = nullptr;
    begin();
  }

  std::size_t threads() const { return threads_; }

  /// Calls `work(0)`, ..., `work(threads() - 1)`, each on a thread of its own, and waits for all. They must
  /// not throw.
  template <class Work>
  void run(const Work& work) {
    while (helpers_.size() + 1 < threads_)
      helpers_.emplace_back([this, index = helpers_.size() + 1, seen = round_.load()] { help(index, seen); });
    work_ = &work;
    call_ = [](const void* any, std::size_t index) { (*static_cast<const Work*>(any))(index); };
    busy_.store(helpers_.size());
    begin();
    work(0);
    for (std::size_t left = busy_.load(); left > 0; left = busy_.load()) busy_.wait(left);
  }

 private:
  void begin() {
    round_.fetch_add(1);
    round_.notify_all();
  }

  void help(std::size_t index, std::size_t seen) {
    for (;; ++seen) {
      round_.wait(seen);
      if (!work_) return;
      call_(work_, index);
      busy_.fetch_sub(1);
      busy_.notify_one();
    }
  }

  std::size_t threads_;
  const void* work_ = nullptr;  ///< null: the helpers end
  void (*call_)(const void*, std::size_t) = nullptr;
  std::atomic<std::size_t> round_{0}, busy_{0};
  std::vector<std::jthread> helpers_;  // the last member: they end before the others go
};

}  // namespace diabolo
