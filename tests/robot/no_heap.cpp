// SPDX-License-Identifier: MIT
// Kinematics take no memory: every allocation of this program is counted.

#include <vector>

#include "catch.hpp"
#include "count_allocations.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/robot/arm/ease_posture.hpp"
#include "diabolo/robot/arm/inverse_near.hpp"
#include "robot/support.hpp"

using namespace diabolo;

namespace {

template <class Scalar>
long allocations_of_kinematics() {
  Random random(41);
  const Chain<Scalar> chain = ur5e_nominal<Scalar>();
  const Vector3<Scalar> tip{Scalar(0.0055), Scalar(-0.043), Scalar(0.356)};
  long sum = 0;
  int found = 0;
  for (int i = 0; i < 100; ++i) {
    const Joints<double> drawn = random_joints(random);
    Joints<Scalar> q;
    for (int k = 0; k < kJointCount; ++k) q[k] = Scalar(drawn[k]);
    const long before = allocations;
    const Pose<Scalar> flange = chain.forward(q);
    found += inverse(flange).count;
    found += inverse_near(chain, flange, q).converged;
    const Vector3<Scalar> target = flange * tip;
    found += stick_inverse(target, tip, posture_of(q)).count;
    found += ease_posture(chain, target, tip, posture_of(q), q).converged;
    sum += allocations - before;
  }
  CHECK(found > 500);
  return sum;
}

}  // namespace

TEST_CASE("the count sees allocations") {
  const long before = allocations;
  const std::vector<double> numbers(1000, 1.0);
  CHECK(allocations > before);
  CHECK(numbers.size() == 1000);
}

TEMPLATE_TEST_CASE("kinematics do not allocate", "", double, float, (Dual<double, 3>)) {
  CHECK(allocations_of_kinematics<TestType>() == 0);
}
