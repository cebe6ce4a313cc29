// SPDX-License-Identifier: MIT
#include "diabolo/math/worker_pool.hpp"

#include "catch.hpp"

using namespace diabolo;

TEST_CASE("each thread of a pool does its share of every piece of work, once") {
  for (const int threads : {1, 2, 3, 8}) {
    WorkerPool pool(threads);
    REQUIRE(pool.threads() == static_cast<std::size_t>(threads));
    std::vector<long> shares(pool.threads(), 0);
    for (long round = 1; round <= 2000; ++round) {
      pool.run([&](std::size_t thread) { shares[thread] += round; });
      for (const long share : shares) REQUIRE(share == round * (round + 1) / 2);
    }
  }
}

TEST_CASE("a pool without work ends") {
  const WorkerPool idle(4);
  CHECK(idle.threads() == 4);
}

TEST_CASE("a pool of fewer than no threads is refused") {
  CHECK_THROWS_WITH(WorkerPool(-1), "threads: -1; must be 0 (one for every processor) or more");
}
