// SPDX-License-Identifier: MIT
#include "diabolo/math/parallel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "catch.hpp"

using namespace diabolo;

TEST_CASE("Every index is worked on once, whatever the number of threads") {
  for (const int threads : {0, 1, 2, 5})
    for (const std::size_t count : std::array<std::size_t, 4>{0, 1, 2, 1000}) {
      std::vector<int> calls(count, 0);
      for_each_index(count, threads, {}, [&](std::size_t i) { ++calls[i]; });
      CHECK(calls == std::vector<int>(count, 1));
    }
}

TEST_CASE("As many threads as wanted work at the same time") {
  for (const int threads : {1, 2, 5}) {
    std::atomic<int> working{0};
    for_each_index(static_cast<std::size_t>(threads), threads, {}, [&](std::size_t) {
      ++working;
      while (working.load() < threads) std::this_thread::yield();
    });
    CHECK(working.load() == threads);
  }
  CHECK(thread_count(0) == std::max(1U, std::thread::hardware_concurrency()));
}

TEST_CASE("Progress runs from 0 to 1 in the thread that asked") {
  std::vector<double> seen;
  const std::thread::id here = std::this_thread::get_id();
  Watch watch;
  watch.progress = [&](double fraction) {
    REQUIRE(std::this_thread::get_id() == here);
    seen.push_back(fraction);
  };
  for_each_index(500, 2, watch, [](std::size_t) {});
  CHECK(seen.front() == 0.0);
  CHECK(seen.back() == 1.0);
  CHECK(std::is_sorted(seen.begin(), seen.end()));
}

TEST_CASE("Cancelling ends the work") {
  std::atomic<int> calls{0};
  Watch watch;
  watch.cancelled = [&] { return calls.load() >= 10; };
  CHECK_THROWS_AS(for_each_index(1000000, 2, watch, [&](std::size_t) { ++calls; }), Cancelled);
  CHECK(calls.load() >= 10);
  CHECK(calls.load() < 1000000);
}

TEST_CASE("An exception of any thread, or of the watch, reaches the caller") {
  const std::thread::id here = std::this_thread::get_id();
  const auto fail_in = [&](int threads, bool caller) {
    std::atomic<bool> began{false}, helped{false};
    for_each_index(1000, threads, {}, [&](std::size_t) {
      const bool is_caller = std::this_thread::get_id() == here;
      (is_caller ? began : helped).store(true);
      while (!began.load() || !helped.load()) std::this_thread::yield();
      if (is_caller == caller) throw std::range_error("work");
    });
  };
  for (const int threads : {2, 5})
    for (const bool caller : {true, false}) CHECK_THROWS_AS(fail_in(threads, caller), std::range_error);
  Watch watch;
  watch.progress = [](double fraction) {
    if (fraction > 0.0) throw std::domain_error("watch");
  };
  CHECK_THROWS_AS(for_each_index(1000, 2, watch, [](std::size_t) {}), std::domain_error);
}
