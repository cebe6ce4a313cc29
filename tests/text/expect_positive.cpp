// SPDX-License-Identifier: MIT
#include "diabolo/text/expect_positive.hpp"

#include <cmath>

#include "catch.hpp"

using namespace diabolo;

TEST_CASE("what is not above zero, or too much, is refused by its name") {
  CHECK_NOTHROW(expect_positive("lead", 1e-300));
  CHECK_NOTHROW(expect_positive("lead", 1.5, 1.5, "rad"));
  CHECK_NOTHROW(expect_positive("jerk", INFINITY, INFINITY));
  CHECK_THROWS_WITH(expect_positive("look, noise", 0.0),
                    "look, noise: 0; expected a positive number up to 1e+06");
  CHECK_THROWS_WITH(expect_positive("lead", 1.6, 1.5, "rad"),
                    "lead: 1.6 rad; expected a positive number up to 1.5");
  for (const double value : {-1.0, -0.0, 2e6, double(NAN), double(INFINITY)})
    CHECK_THROWS_AS(expect_positive("noise", value), std::invalid_argument);
}
