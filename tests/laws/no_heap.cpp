// SPDX-License-Identifier: MIT
// A step takes no memory: every allocation of this program is counted.

#include <vector>

#include "catch.hpp"
#include "count_allocations.hpp"
#include "diabolo/full_predictor.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/math/pack.hpp"
#include "smooth_tips.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

/// Allocations of many steps through swings, snaps, flights, catches and overstretched tips.
template <class Scalar>
long allocations_of(const Parameters<Scalar>& parameters) {
  const FullPredictor<Scalar> predictor(parameters);
  const auto cast = [](const Vector& v) { return Vector3<Scalar>(Scalar(v[0]), Scalar(v[1]), Scalar(v[2])); };
  Random random(1000);
  long sum = 0;
  for (int episode = 0; episode < 20; ++episode) {
    const SmoothTips player = SmoothTips::random(random, random.uniform(0.0, 1.5), 0.4, 15.0);
    const auto tips_at = [&](double t) {
      const Tips<double> tips = player.at(t);
      return Tips<Scalar>{cast(tips.left), cast(tips.right), cast(tips.left_velocity),
                          cast(tips.right_velocity)};
    };
    State<Scalar> state;
    state.position = cast(random.vector(0.7));
    state.velocity = cast(random.vector(5.0));
    state.string_state = static_cast<StringState>(episode % 3);
    for (int k = 0; k < 100; ++k) {
      const Tips<Scalar> now = tips_at(k * 1e-3), next = tips_at((k + 1) * 1e-3);
      const long before = allocations;
      predictor.step(state, now, next, Scalar(1e-3));
      sum += allocations - before;
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("the count sees allocations, Eigen's too") {
  const long before = allocations;
  const Eigen::VectorXd vector = Eigen::VectorXd::Zero(1000);
  const std::vector<double> numbers(1000, vector[0]);
  CHECK(allocations > before);
  CHECK(numbers.size() == 1000);
}

TEMPLATE_TEST_CASE("no step allocates", "", double, float, (Dual<double, 13>), (Pack<double, 4>)) {
  CHECK(allocations_of(Parameters<TestType>::consistent()) == 0);
  CHECK(allocations_of(Parameters<TestType>::paper()) == 0);
  CHECK(allocations_of(Parameters<TestType>::published()) == 0);
}
