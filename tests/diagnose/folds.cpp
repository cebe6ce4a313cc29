// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/folds.hpp"

#include "catch.hpp"

using namespace diabolo;

TEST_CASE("several recordings are left out whole, the only one in three blocks") {
  const std::vector<Fold> whole = folds_of({{1, 10, 20}, {4, 0, 5}});
  REQUIRE(whole.size() == 2);
  CHECK(whole[0].fit_take == 1);
  CHECK(whole[0].first == 10);
  CHECK(whole[0].last == 20);
  CHECK(whole[1].fit_take == 4);

  const std::vector<Fold> blocks = folds_of({{2, 100, 109}});
  REQUIRE(blocks.size() == 3);
  Eigen::Index next = 100;
  for (const Fold& block : blocks) {
    CHECK(block.fit_take == 2);
    CHECK(block.first == next);
    next = block.last + 1;
  }
  CHECK(next == 110);
}

TEST_CASE("rows touch where they share one, of the same recording") {
  CHECK(touch({0, 3, 5}, {0, 5, 9}));
  CHECK_FALSE(touch({0, 3, 5}, {0, 6, 9}));
  CHECK_FALSE(touch({0, 3, 5}, {1, 3, 5}));
}
