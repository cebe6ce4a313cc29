// SPDX-License-Identifier: MIT
#include "diabolo/robot/arm/stick_task.hpp"

#include <limits>

#include "catch.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/robot/arm/ease_posture.hpp"
#include "robot/support.hpp"

using namespace diabolo;

namespace {

const Vector3<double> kTip{0.0055, -0.043, 0.356};  // of the paper's right arm

}  // namespace

TEST_CASE("the stick task in closed form meets the tip and keeps the posture") {
  Random random(31);
  const Chain<double> chain = ur5e_nominal<double>();
  for (int i = 0; i < 50000; ++i) {
    const Joints<double> q = random_joints(random);
    const Vector3<double> target = chain.forward(q) * kTip;
    const StickSolutions<double> solutions = stick_inverse<double>(target, kTip, posture_of(q));
    REQUIRE(solutions.count > 0);
    REQUIRE(solutions.count % 2 == 0);
    double nearest = 10;
    for (const StickSolution<double>& s : solutions) {
      REQUIRE((chain.forward(s.joints) * kTip - target).norm() <= 1e-12);
      REQUIRE(std::abs(posture_of(s.joints).pitch - posture_of(q).pitch) <= 1e-14 * 20);
      REQUIRE(s.joints[4] == q[4]);
      REQUIRE(s.joints[5] == q[5]);
      nearest = std::min(nearest, turned_apart(s.joints, q));
      for (const StickSolution<double>& other : solutions)
        if (&other != &s) REQUIRE(other.branch != s.branch);
    }
    const auto chosen = nearest_solution(solutions, q);
    REQUIRE(chosen);
    REQUIRE(posture_of(chosen->joints).pitch == Approx(posture_of(q).pitch).margin(2 * M_PI + 1e-9));
    // How far the tip is from the shoulder's fold: only there may rounding grow.
    if (!solutions.all[0].shoulder_singular && std::abs(std::sin(q[2])) > 1e-3) REQUIRE(nearest <= 1e-6);
  }
}

TEST_CASE("a tip out of the posture's reach has no solution") {
  const Posture<double> posture{-1.5 * M_PI, M_PI, 0};
  CHECK(stick_inverse<double>({2, 0, 0.5}, kTip, posture).count == 0);
  CHECK(stick_inverse<double>({0.01, 0, 0.5}, kTip, posture).count == 0);  // nearer than the stick is aside
  CHECK(stick_inverse<double>({std::numeric_limits<double>::quiet_NaN(), 0, 0.5}, kTip, posture).count == 0);
  CHECK(stick_inverse<double>({0.6, 0, 0.5}, kTip, {std::numeric_limits<double>::infinity(), 0, 0}).count ==
        0);
}

TEST_CASE("on a calibrated arm Newton's method meets the tip and keeps the posture") {
  Random random(32);
  int tries = 0, converged = 0;
  for (int i = 0; i < 20000; ++i) {
    const Chain<double> chain = ur5e_from_calibration<double>(random_calibration(random));
    Joints<double> q = random_joints(random);
    q[2] = random.uniform(0.3, 2.6);  // away from the fold, where the task is singular
    const Vector3<double> target = chain.forward(q) * kTip;
    if (std::abs(target.x() * std::cos(q[0]) + target.y() * std::sin(q[0])) < 0.1) continue;  // the other one
    const auto seed = nearest_solution(stick_inverse<double>(target, kTip, posture_of(q)), q);
    ++tries;
    if (!seed) continue;
    const Refined<double> refined = refine_tip<double>(chain, target, kTip, seed->joints);
    if (!refined.converged) continue;
    ++converged;
    REQUIRE((chain.forward(refined.joints) * kTip - target).cwiseAbs().maxCoeff() <= 1e-11);
    REQUIRE(std::abs(posture_of(refined.joints).pitch - posture_of(seed->joints).pitch) <= 1e-13);
    REQUIRE(refined.joints[4] == seed->joints[4]);
    REQUIRE(refined.joints[5] == seed->joints[5]);
  }
  CHECK(converged >= 0.99 * tries);
}

TEST_CASE("where the posture reaches, easing it gives the closed form") {
  Random random(33);
  const Chain<double> chain = ur5e_nominal<double>();
  for (int i = 0; i < 300; ++i) {
    Joints<double> q;
    q << random.uniform(2.5, 4), random.uniform(-1.5, -0.9), random.uniform(-2.2, -1.5), 0, M_PI, 0;
    const Posture<double> goal{-1.5 * M_PI, M_PI + random.uniform(-1, 1), 0};
    q[3] = goal.pitch - q[1] - q[2];
    q[4] = goal.wrist_2;
    const Vector3<double> target = chain.forward(q) * kTip;
    Joints<double> seed = q;
    for (int k = 0; k < 6; ++k) seed[k] += random.uniform(-0.2, 0.2);
    const Refined<double> eased = ease_posture<double>(chain, target, kTip, goal, seed);
    REQUIRE(eased.converged);
    REQUIRE((eased.joints - q).cwiseAbs().maxCoeff() <= 1e-6);
  }
}

TEST_CASE("where the posture must give way, no other way of reaching the tip costs less") {
  Random random(34);
  const Chain<double> chain = ur5e_nominal<double>();
  const Posture<double> goal{-1.5 * M_PI, M_PI, 0};
  const auto cost = [&](const Joints<double>& q) {
    const Posture<double> p = posture_of(q);
    const double a = p.pitch - goal.pitch, b = p.wrist_2 - goal.wrist_2, c = p.wrist_3 - goal.wrist_3;
    return a * a + 0.2 * b * b + c * c;
  };
  int given_way = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3<double> target{-random.uniform(0.75, 1.0), random.uniform(-0.5, 0.2),
                                 random.uniform(0.3, 0.6)};
    Joints<double> seed;
    seed << 3.0, -2.0, -1.2, -1.5, M_PI, 0;
    const Refined<double> eased = ease_posture<double>(chain, target, kTip, goal, seed);
    REQUIRE(eased.converged);
    REQUIRE((chain.forward(eased.joints) * kTip - target).cwiseAbs().maxCoeff() <= 1e-11);
    if (cost(eased.joints) < 1e-8) continue;
    ++given_way;
    for (int k = 0; k < 50; ++k) {  // neighbours on the surface of equal tips
      Joints<double> other = eased.joints;
      for (int j = 0; j < 6; ++j) other[j] += random.uniform(-0.02, 0.02);
      const Refined<double> back = refine_tip<double>(chain, target, kTip, other, 20);
      if (back.converged) REQUIRE(cost(back.joints) >= cost(eased.joints) - 1e-9);
    }
  }
  CHECK(given_way > 20);
}

TEST_CASE("the stick task goes through in single precision and with derivatives") {
  Random random(35);
  using D = Dual<double, 3>;
  const Chain<double> chain = ur5e_nominal<double>();
  const Chain<float> single = ur5e_nominal<float>();
  for (int i = 0; i < 200; ++i) {
    Joints<double> q;
    q << random.uniform(2.5, 4), random.uniform(-1.5, -0.9), random.uniform(-2.2, -1.5), -1.4, 3.3, 0.1;
    const Vector3<double> target = chain.forward(q) * kTip;
    const Posture<double> p = posture_of(q);
    const auto rough = nearest_solution(
        stick_inverse<float>(
            target.cast<float>(), kTip.cast<float>(),
            {static_cast<float>(p.pitch), static_cast<float>(p.wrist_2), static_cast<float>(p.wrist_3)}),
        Joints<float>(q.cast<float>()));
    REQUIRE(rough);
    REQUIRE((single.forward(rough->joints) * kTip.cast<float>() - target.cast<float>()).norm() <= 1e-5F);

    Vector3<D> moving, tip;
    Joints<D> start;
    for (int k = 0; k < 3; ++k) moving[k] = D::variable(target[k], k);
    for (int k = 0; k < 3; ++k) tip[k] = D(kTip[k]);
    for (int k = 0; k < 6; ++k) start[k] = D(q[k]);
    const auto found =
        nearest_solution(stick_inverse<D>(moving, tip, {D(p.pitch), D(p.wrist_2), D(p.wrist_3)}), start);
    REQUIRE(found);
    const double h = 1e-5;
    for (int k = 0; k < 3; ++k) {
      Vector3<double> up = target, down = target;
      up[k] += h;
      down[k] -= h;
      const auto a = nearest_solution(stick_inverse<double>(up, kTip, p), q);
      const auto b = nearest_solution(stick_inverse<double>(down, kTip, p), q);
      REQUIRE((a && b));
      for (int j = 0; j < 6; ++j) {
        const double slope = (a->joints[j] - b->joints[j]) / (2 * h);
        REQUIRE(std::abs(found->joints[j].gradient[k] - slope) <= 1e-5 * (1 + std::abs(slope)));
      }
    }
  }
}
