// SPDX-License-Identifier: MIT
// One law, every scalar: what a rollout is does not depend on the numbers it is computed with.

#include "diabolo/math/dual.hpp"
#include "laws/rollouts_of_scalar.hpp"

using namespace diabolo;

TEST_CASE("single precision rolls out to the motion that double gives") { check_rollouts_of_scalar<float>(); }

TEST_CASE("a dual rolls out to the motion that double gives") { check_rollouts_of_scalar<Dual<double, 2>>(); }

TEST_CASE("a dual over float rolls out to the motion and the derivative that double gives") {
  check_rollouts_of_scalar<Dual<float, 1>>();
}
