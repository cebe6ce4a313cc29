// SPDX-License-Identifier: MIT
// One law, every scalar: what a rollout is does not depend on the numbers it is computed with.

#include "diabolo/math/dual.hpp"
#include "diabolo/math/pack.hpp"
#include "laws/rollouts_of_scalar.hpp"

using namespace diabolo;

TEST_CASE("a dual over a pack rolls out to the motion that double gives") {
  check_rollouts_of_scalar<Dual<Pack<double, 4>, 1>>();
}
