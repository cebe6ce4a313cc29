// SPDX-License-Identifier: MIT
#include "diabolo/estimate/arm_forces.hpp"

#include "catch.hpp"
#include "random.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

Joints<double> working_joints(Random& random) {
  Joints<double> joints;
  joints << 3.0, -1.0, 1.3, -1.9, 3.14, 0.0;
  for (int i = 0; i < 6; ++i) joints[i] += random.uniform(-0.2, 0.2);
  return joints;
}

}  // namespace

TEST_CASE("the torques of a force on the tip give that force, from any base") {
  const unsigned seed = 101;
  CAPTURE(seed);
  Random random(seed);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const StickArm arm = paper_arm(side);
    for (int trial = 0; trial < 20; ++trial) {
      const Joints<double> joints = working_joints(random);
      const Vector3<double> force = random.vector(5.0);
      // Virtual work: power of the force is that of the torques, for each joint's speed in turn.
      Joints<double> torque;
      constexpr double kTurn = 1e-6;
      for (int i = 0; i < 6; ++i) {
        Joints<double> more = joints, less = joints;
        more[i] += kTurn;
        less[i] -= kTurn;
        torque[i] = force.dot(arm.tip_at(more) - arm.tip_at(less)) / (2.0 * kTurn);
      }
      const ArmForce found = force_by_torques(arm, {joints, torque, 0.1});
      CHECK((found.force - force).norm() < 1e-6);  // of the differences
    }
  }
}

TEST_CASE("the noise of a force by torques is what the torques' noise makes of it") {
  const unsigned seed = 102;
  CAPTURE(seed);
  Random random(seed);
  const StickArm arm = paper_arm(Side::kLeft);
  const Joints<double> joints = working_joints(random);
  const auto found = [&](const Joints<double>& torque) {
    return force_by_torques(arm, {joints, torque, 0.2});
  };
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 6; ++i) {
    const Vector3<double> by_one = found(0.2 * Joints<double>::Unit(i)).force;
    expected += by_one * by_one.transpose();
  }
  const MatrixOf<3> noise = found(Joints<double>::Zero()).noise;
  CHECK((noise * noise.transpose() - expected).norm() < 1e-6 * expected.norm());
}

TEST_CASE("torques that are no numbers are refused") {
  JointTorques read{Joints<double>::Zero(), Joints<double>::Zero(), 0.2};
  read.torque[3] = std::nan("");
  CHECK_THROWS_WITH(force_by_torques(paper_arm(Side::kLeft), read), Contains("joint torques, torque"));
  read.torque[3] = 0.0;
  read.noise = 0.0;
  CHECK_THROWS_WITH(force_by_torques(paper_arm(Side::kLeft), read),
                    Contains("noise") && Contains("a positive number"));
}
