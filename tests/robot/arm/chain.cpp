// SPDX-License-Identifier: MIT
#include "diabolo/robot/arm/chain.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "catch.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/robot/arm/gravity_torque.hpp"
#include "random.hpp"
#include "robot/support.hpp"

using namespace diabolo;

namespace {

/// The product of the first Denavit-Hartenberg matrices, as a textbook has it.
Eigen::Matrix4d denavit_hartenberg(const Joints<double>& q, int count = 6) {
  const Ur5eLengths l;
  const double d[] = {l.d1, 0, 0, l.d4, l.d5, l.d6}, a[] = {0, l.a2, l.a3, 0, 0, 0};
  const double alpha[] = {M_PI / 2, 0, 0, M_PI / 2, -M_PI / 2, 0};
  Eigen::Matrix4d product = Eigen::Matrix4d::Identity();
  for (int i = 0; i < count; ++i) {
    const double ct = std::cos(q[i]), st = std::sin(q[i]), ca = std::cos(alpha[i]), sa = std::sin(alpha[i]);
    Eigen::Matrix4d link;
    link << ct, -st * ca, st * sa, a[i] * ct, st, ct * ca, -ct * sa, a[i] * st, 0, sa, ca, d[i], 0, 0, 0, 1;
    product = product * link;
  }
  return product;
}

}  // namespace

TEST_CASE("the chain is the product of the Denavit-Hartenberg matrices") {
  Random random(1);
  const Chain<double> chain = ur5e_nominal<double>();
  for (int i = 0; i < 10000; ++i) {
    const Joints<double> q = random_joints(random);
    const Pose<double> flange = chain.forward(q);
    const Eigen::Matrix4d expected = denavit_hartenberg(q);
    REQUIRE((flange.position - expected.topRightCorner<3, 1>()).cwiseAbs().maxCoeff() <= 1e-12);
    REQUIRE((flange.rotation - expected.topLeftCorner<3, 3>()).cwiseAbs().maxCoeff() <= 1e-12);
  }
}

TEST_CASE("a UR5e's controller gives the same flange positions") {
  const Chain<double> chain = ur5e_nominal<double>();
  const auto flange = [&](std::initializer_list<double> q) {
    Joints<double> joints;
    std::copy(q.begin(), q.end(), joints.data());
    return chain.forward(joints).position;
  };
  const double quarter = M_PI / 2;
  CHECK((flange({0, 0, 0, 0, 0, 0}) - Vector3<double>(-0.8172, -0.2329, 0.0628)).norm() <= 1e-6);
  CHECK((flange({0, -quarter, 0, -quarter, 0, 0}) - Vector3<double>(0, -0.2329, 1.0794)).norm() <= 1e-6);
  CHECK((flange({-1.54, -1.83, -2.28, -0.59, 1.6, 0.023}) - Vector3<double>(-0.117025, -0.435893, 0.151821))
            .norm() <= 1e-6);
}

TEST_CASE("the Jacobian is the derivative of the point and of the rotation") {
  Random random(2);
  const Chain<double> chain = ur5e_nominal<double>();
  for (int i = 0; i < 200; ++i) {
    const Joints<double> q = random_joints(random);
    const Vector3<double> tip = random.vector(0.4);
    const Jacobian<double> jacobian = chain.jacobian(q, tip);
    const double step = 1e-5;
    for (int k = 0; k < 6; ++k) {
      Joints<double> up = q, down = q;
      up[k] += step;
      down[k] -= step;
      const Pose<double> a = chain.forward(up), b = chain.forward(down);
      const Vector3<double> velocity = (a * tip - b * tip) * (0.5 / step);
      const Eigen::Matrix3d turn =
          (a.rotation - b.rotation) * (0.5 / step) * chain.forward(q).rotation.transpose();
      const Vector3<double> rate(turn(2, 1), turn(0, 2), turn(1, 0));
      REQUIRE((jacobian.col(k).head<3>() - velocity).cwiseAbs().maxCoeff() <= 1e-8);
      REQUIRE((jacobian.col(k).tail<3>() - rate).cwiseAbs().maxCoeff() <= 1e-8);
    }
  }
}

TEST_CASE("the Jacobian is that of a dual number") {
  Random random(3);
  using D = Dual<double, 6>;
  const Chain<double> chain = ur5e_nominal<double>();
  const Chain<D> dual_chain = ur5e_nominal<D>();
  const Joints<double> q = random_joints(random);
  Joints<D> dual;
  for (int k = 0; k < 6; ++k) dual[k] = D::variable(q[k], k);
  const Pose<D> flange = dual_chain.forward(dual);
  const Jacobian<double> jacobian = chain.jacobian(q, Vector3<double>::Zero());
  for (int row = 0; row < 3; ++row)
    for (int k = 0; k < 6; ++k) CHECK(std::abs(flange.position[row].gradient[k] - jacobian(row, k)) <= 1e-12);
}

TEST_CASE("at the three singularities the arm cannot move in every direction") {
  Random random(4);
  const Chain<double> chain = ur5e_nominal<double>();
  const Ur5eLengths l;
  const Vector3<double> flange = Vector3<double>::Zero();
  const auto manipulability = [&](const Joints<double>& q) {
    return std::abs(chain.jacobian(q, flange).determinant());
  };
  double typical = 0;
  for (int i = 0; i < 50; ++i) {
    Joints<double> wrist = random_joints(random), elbow = wrist, shoulder = wrist;
    typical = std::max(typical, manipulability(wrist));
    wrist[4] = random.chance(0.5) ? 0 : M_PI;
    elbow[2] = 0;
    // The wrist above the base axis: a2 c2 + a3 c23 + d5 s234 = 0, solved for q4.
    const double sine = -(l.a2 * std::cos(shoulder[1]) + l.a3 * std::cos(shoulder[1] + shoulder[2])) / l.d5;
    CHECK(manipulability(wrist) <= 1e-15);
    CHECK(manipulability(elbow) <= 1e-15);
    if (std::abs(sine) > 1) continue;
    shoulder[3] = std::asin(sine) - shoulder[1] - shoulder[2];
    CHECK(manipulability(shoulder) <= 1e-15);
  }
  CHECK(typical > 1e-2);
}

TEST_CASE("the torque that holds the arm is the slope of its potential energy") {
  Random random(5);
  const Chain<double> chain = ur5e_nominal<double>();
  LinkMasses<double> masses = ur5e_masses<double>();
  masses[5] = {1.2, {0.01, -0.02, 0.2}};  // with a stick
  for (int i = 0; i < 200; ++i) {
    const Joints<double> q = random_joints(random);
    const Vector3<double> gravity = random.vector(9.81);
    const auto energy = [&](const Joints<double>& joints) {
      double sum = 0;
      const Chain<double>::Links frames = chain.frames(joints);
      for (std::size_t k = 0; k < 6; ++k) sum -= masses[k].mass * gravity.dot(frames[k] * masses[k].center);
      return sum;
    };
    const Joints<double> torque = gravity_torque(chain, masses, q, gravity);
    const double h = 1e-3;  // of a rule of sixth order: its error and that of rounding stay below 1e-10 N m
    for (int k = 0; k < 6; ++k) {
      const auto moved = [&](double by) {
        Joints<double> joints = q;
        joints[k] += by * h;
        return energy(joints);
      };
      const double slope =
          (45 * (moved(1) - moved(-1)) - 9 * (moved(2) - moved(-2)) + moved(3) - moved(-3)) / (60 * h);
      REQUIRE(std::abs(torque[k] - slope) <= 1e-9);
    }
  }
}

TEST_CASE("the centres of mass are where the maker's table has them") {
  // In Denavit-Hartenberg frames, each at the far end of its link.
  const Vector3<double> table[] = {{0, -0.02561, 0.00193}, {0.2125, 0, 0.11336}, {0.15, 0, 0.0265},
                                   {0, -0.0018, 0.01634},  {0, 0.0018, 0.01634}, {0, 0, -0.001159}};
  Random random(6);
  const LinkMasses<double> masses = ur5e_masses<double>();
  for (int i = 0; i < 20; ++i) {
    const Joints<double> q = random_joints(random);
    const Chain<double>::Links frames = ur5e_nominal<double>().frames(q);
    for (int link = 0; link < 6; ++link) {
      const std::size_t k = static_cast<std::size_t>(link);
      const Eigen::Vector4d expected = denavit_hartenberg(q, link + 1) * table[k].homogeneous();
      CHECK((frames[k] * masses[k].center - expected.head<3>()).norm() <= 1e-14);
    }
  }
}

TEST_CASE("a UR5e that lies flat needs the torque of its own weight at the shoulder") {
  const LinkMasses<double> masses = ur5e_masses<double>();
  const Joints<double> torque = gravity_torque<double>(ur5e_nominal<double>(), masses, Joints<double>::Zero(),
                                                       Vector3<double>(0, 0, -9.81));
  // Upper arm at half its length, forearm 0.15 m before its end, the wrists at their places; see
  // gravity_torque.
  const double expected = 9.81 * (8.058 * 0.2125 + 2.846 * (0.8172 - 0.15) + (1.37 + 1.3 + 0.365) * 0.8172);
  CHECK(std::abs(torque[1]) == Approx(expected).epsilon(1e-9));
}
