// SPDX-License-Identifier: MIT
#include <limits>
#include <string>

#include <Eigen/Geometry>

#include "catch.hpp"
#include "diabolo/robot/arm/inverse_near.hpp"
#include "diabolo/robot/arm/stick_task.hpp"
#include "robot/support.hpp"

using namespace diabolo;

TEST_CASE("a calibrated chain is the product of its links") {
  Random random(21);
  for (int i = 0; i < 1000; ++i) {
    const Ur5eCalibration calibration = random_calibration(random);
    const Joints<double> q = random_joints(random);
    Eigen::Isometry3d product = Eigen::Isometry3d::Identity();
    for (std::size_t k = 0; k < 6; ++k) {
      const LinkCalibration& link = calibration[k];
      product = product * Eigen::Translation3d(link.x, link.y, link.z) *
                Eigen::AngleAxisd(link.yaw, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(link.pitch, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(link.roll, Eigen::Vector3d::UnitX()) *
                Eigen::AngleAxisd(q[static_cast<int>(k)], Eigen::Vector3d::UnitZ());
    }
    const Pose<double> flange = ur5e_from_calibration<double>(calibration).forward(q);
    REQUIRE((flange.position - product.translation()).cwiseAbs().maxCoeff() <= 1e-13);
    REQUIRE((flange.rotation - product.linear()).cwiseAbs().maxCoeff() <= 1e-13);
  }
}

TEST_CASE("the calibration of the data sheet is the nominal arm") {
  Random random(22);
  const Chain<double> nominal = ur5e_nominal<double>();
  const Chain<double> calibrated = ur5e_from_calibration<double>(nominal_calibration());
  for (int i = 0; i < 100; ++i) {
    const Joints<double> q = random_joints(random);
    CHECK(apart(nominal.forward(q), calibrated.forward(q)) <= 1e-14);
  }
}

TEST_CASE("a wrong calibration is refused in a sentence") {
  Ur5eCalibration calibration = nominal_calibration();
  calibration[2].x = std::numeric_limits<double>::quiet_NaN();
  CHECK(message_of<std::invalid_argument>([&] { ur5e_from_calibration<double>(calibration); }) ==
        "calibration, link 3: nan; must be finite");
  calibration[2].x = -425;  // in millimetres
  CHECK(message_of<std::invalid_argument>([&] { ur5e_from_calibration<double>(calibration); }) ==
        "calibration, link 3: 425 m from the link before; must be within 1 m");
}

TEST_CASE("Newton's method takes a nominal solution to the calibrated arm, or says that it did not") {
  Random random(23);
  const int tries = 20000;
  int converged = 0, farthest = 0;
  for (int i = 0; i < tries; ++i) {
    const Chain<double> chain = ur5e_from_calibration<double>(random_calibration(random));
    const Joints<double> q = random_joints(random);
    const Pose<double> flange = chain.forward(q);
    if (margins(q).least() > 0.2) REQUIRE(turned_apart(inverse_near(chain, flange, q).joints, q) <= 1e-8);
    const Refined<double> refined = inverse_near(chain, flange, q);
    const double error = apart(chain.forward(refined.joints), flange);
    if (refined.converged) REQUIRE(error <= 1e-11);
    if (error > 2e-11) REQUIRE_FALSE(refined.converged);
    converged += refined.converged;
    farthest = std::max(farthest, refined.steps);
  }
  INFO(converged << " of " << tries << " in at most " << farthest << " steps");
  CHECK(converged >= 0.99 * tries);
  CHECK(farthest <= 6);
}

TEST_CASE("a pose that no step reaches is reported and stays finite") {
  const Chain<double> chain = ur5e_nominal<double>();
  Joints<double> q;
  q << 0.3, -1.0, 1.2, 0.4, 0.7, 0.1;
  Pose<double> flange = chain.forward(q);
  flange.position = {2, 0, 0};
  const Refined<double> refined = refine_pose(chain, flange, q);
  CHECK_FALSE(refined.converged);
  CHECK(refined.error > 0.1);
  // Half a turn away the small-angle error of the rotation is zero: that is no solution.
  flange = chain.forward(q);
  flange.rotation = Eigen::AngleAxisd(M_PI, Vector3<double>(flange.rotation.col(2))) * flange.rotation;
  CHECK_FALSE(refine_pose(chain, flange, q, 0).converged);
}
