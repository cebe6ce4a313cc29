// SPDX-License-Identifier: MIT
// Orocos KDL as an independent judge.

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "catch.hpp"
#include "diabolo/robot/arm/chain.hpp"
#include "robot/support.hpp"

using namespace diabolo;

namespace {

KDL::Chain kdl_arm() {
  const Ur5eLengths l;
  const double d[] = {l.d1, 0, 0, l.d4, l.d5, l.d6}, a[] = {0, l.a2, l.a3, 0, 0, 0};
  const double alpha[] = {M_PI / 2, 0, 0, M_PI / 2, -M_PI / 2, 0};
  KDL::Chain chain;
  for (int i = 0; i < 6; ++i)
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), KDL::Frame::DH(a[i], alpha[i], d[i], 0)));
  return chain;
}

}  // namespace

TEST_CASE("KDL finds the same flange and the same Jacobian") {
  Random random(6);
  const KDL::Chain judge = kdl_arm();
  KDL::ChainFkSolverPos_recursive positions(judge);
  KDL::ChainJntToJacSolver slopes(judge);
  const Chain<double> chain = ur5e_nominal<double>();
  KDL::JntArray angles(6);
  KDL::Jacobian expected_slopes(6);
  for (int i = 0; i < 10000; ++i) {
    const Joints<double> q = random_joints(random);
    angles.data = q;
    KDL::Frame expected;
    REQUIRE(positions.JntToCart(angles, expected) >= 0);
    REQUIRE(slopes.JntToJac(angles, expected_slopes) >= 0);
    const Pose<double> flange = chain.forward(q);
    for (int row = 0; row < 3; ++row) {
      REQUIRE(std::abs(flange.position[row] - expected.p[row]) <= 1e-12);
      for (int column = 0; column < 3; ++column)
        REQUIRE(std::abs(flange.rotation(row, column) - expected.M(row, column)) <= 1e-12);
    }
    const Jacobian<double> jacobian = chain.jacobian(q, Vector3<double>::Zero());
    REQUIRE((jacobian - expected_slopes.data).cwiseAbs().maxCoeff() <= 1e-12);
  }
}
