// SPDX-License-Identifier: MIT
#include "diabolo/plan/aim_again.hpp"

#include <cmath>

#include "catch.hpp"

using namespace diabolo;

TEST_CASE("a throw aimed again comes nearer by the share that the model is wrong") {
  const ThrowAim wanted{0.6, 0.2};
  /// Comes a tenth too low and 8 cm to the right.
  const auto thrown = [](const ThrowAim& aim) {
    return ThrowAim{0.9 * aim.height, 1.05 * aim.sideways - 0.08};
  };
  ThrowAim aim = wanted;
  double last_high = 1.0, last_aside = 1.0;
  for (int i = 0; i < 4; ++i) {
    const ThrowAim came = thrown(aim);
    const double high = std::abs(came.height - wanted.height),
                 aside = std::abs(came.sideways - wanted.sideways);
    if (i > 0) {
      CHECK(high == Approx(0.1 * last_high));
      CHECK(aside == Approx(0.05 * last_aside));
    }
    last_high = high;
    last_aside = aside;
    aim = aimed_again(aim, wanted, came);
  }
  CHECK(last_high < 1e-4);
  const ThrowAim hit = aimed_again(aim, wanted, wanted);
  CHECK(hit.height == aim.height);
  CHECK(hit.sideways == aim.sideways);
}
