// SPDX-License-Identifier: MIT
#include "diabolo/plan/turned.hpp"

#include "catch.hpp"
#include "plan/level_scene.hpp"

using namespace diabolo;
using namespace level_scene;

TEST_CASE("a turn of the hands keeps their distance, their heights and their middle") {
  Tips<double> base = home();
  base.left.z() += 0.2;
  const Turned turn{0.5, 0.2, 0.5 * (base.left + base.right)};
  const Tips<double> turned = turn(base);
  CHECK((turned.left + turned.right - base.left - base.right).norm() < 1e-15);
  CHECK(turned.left.z() == base.left.z());
  CHECK((turned.left - turned.right).norm() == Approx((base.left - base.right).norm()));
  CHECK((turned.left - turned.right).x() == Approx(-0.6 * std::sin(0.7)));
}
