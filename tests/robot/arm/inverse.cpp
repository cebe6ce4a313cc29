// SPDX-License-Identifier: MIT
#include "diabolo/robot/arm/inverse.hpp"

#include <array>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "catch.hpp"
#include "diabolo/math/dual.hpp"
#include "robot/support.hpp"

using namespace diabolo;

TEST_CASE("every solution has the pose, and the joints it was made of are among them") {
  Random random(11);
  const Chain<double> chain = ur5e_nominal<double>();
  std::array<int, 9> counts{};
  for (int i = 0; i < 200000; ++i) {
    const Joints<double> q = random_joints(random);
    const Pose<double> flange = chain.forward(q);
    const InverseSolutions<double> solutions = inverse(flange);
    REQUIRE(solutions.fault == PoseFault::kNone);
    REQUIRE(solutions.count > 0);
    REQUIRE(solutions.count % 2 == 0);
    ++counts[static_cast<std::size_t>(solutions.count)];
    double nearest = 10;
    for (const InverseSolution<double>& s : solutions) {
      REQUIRE(s.joints.allFinite());
      REQUIRE(apart(chain.forward(s.joints), flange) <= 1e-12);
      nearest = std::min(nearest, turned_apart(s.joints, q));
      for (const InverseSolution<double>& other : solutions)
        if (&other != &s) REQUIRE(other.branch != s.branch);
    }
    const Margins at = margins(q);
    if (at.least() > 1e-3) REQUIRE(nearest <= 1e-8);
    if (at.least() < 0.05) continue;  // farther from any fold no two solutions are the same
    for (const InverseSolution<double>& s : solutions)
      for (const InverseSolution<double>& other : solutions)
        if (other.branch < s.branch && margins(s.joints).least() > 0.05)
          REQUIRE(turned_apart(s.joints, other.joints) > 1e-3);
  }
  INFO(counts[2] << ' ' << counts[4] << ' ' << counts[6] << ' ' << counts[8]);
  // Shares seen with an independent implementation: 8 solutions 76 %, 6: 6 %, 4: 15 %, 2: 3 %.
  CHECK(counts[8] / 200000.0 == Approx(0.76).margin(0.01));
  CHECK(counts[6] / 200000.0 == Approx(0.06).margin(0.01));
  CHECK(counts[4] / 200000.0 == Approx(0.15).margin(0.01));
  CHECK(counts[2] / 200000.0 == Approx(0.03).margin(0.01));
}

TEST_CASE("a pose that moves a little moves the solution of each branch a little") {
  Random random(12);
  const Chain<double> chain = ur5e_nominal<double>();
  for (int i = 0; i < 20000; ++i) {
    const Pose<double> flange = chain.forward(random_joints(random));
    Pose<double> moved = flange;
    moved.position += random.vector(1e-6);
    moved.rotation = Eigen::AngleAxisd(1e-6, random.direction()) * moved.rotation;
    const InverseSolutions<double> before = inverse(flange), after = inverse(moved);
    for (const InverseSolution<double>& s : before) {
      if (margins(s.joints).least() < 0.05) continue;
      bool found = false;
      for (const InverseSolution<double>& other : after)
        if (other.branch == s.branch) {
          found = true;
          REQUIRE(turned_apart(other.joints, s.joints) < 2e-3);
        }
      REQUIRE(found);
    }
  }
}

TEST_CASE("what cannot be reached or is no pose gives no solution and no NaN") {
  Random random(13);
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  int reached = 0;
  for (int i = 0; i < 100000; ++i) {
    Pose<double> pose;
    pose.rotation = random.rotation();
    pose.position = random.direction() * random.log_uniform(1e-3, 1e3);
    const InverseSolutions<double> solutions = inverse(pose);
    CHECK(solutions.fault == PoseFault::kNone);
    reached += solutions.count > 0;
    if (pose.position.norm() > 1.5) REQUIRE(solutions.count == 0);
    for (const InverseSolution<double>& s : solutions) REQUIRE(s.joints.allFinite());
    Pose<double> broken = pose;
    const int number = random.index(12);
    double& entry = number < 9 ? broken.rotation.data()[number] : broken.position[number - 9];
    entry = random.chance(0.5) ? nan : infinity;
    REQUIRE(inverse(broken).fault == PoseFault::kNotFinite);
    REQUIRE(inverse(broken).count == 0);
    broken = pose;
    broken.rotation.col(random.index(3)) *= random.chance(0.5) ? -1.0 : 1.001;
    REQUIRE(inverse(broken).fault == PoseFault::kNotRotation);
    REQUIRE(inverse(broken).count == 0);
  }
  CHECK(reached > 1000);
  CHECK(inverse(Pose<double>(), nan).count == 0);
}

TEST_CASE("up to a singularity and in it there is a solution, it has the pose, and it says so") {
  Random random(14);
  const Chain<double> chain = ur5e_nominal<double>();
  const Ur5eLengths l;
  std::vector<double> distances{0.0};
  for (int k = 1; k <= 12; ++k) distances.push_back(std::pow(10.0, -k));
  for (int i = 0; i < 2000; ++i) {
    for (const double distance : distances) {
      Joints<double> wrist = random_joints(random), elbow = wrist, shoulder = wrist;
      wrist[4] = (random.chance(0.5) ? M_PI : 0) + distance;
      elbow[2] = distance;
      const double along =
          distance - l.a2 * std::cos(shoulder[1]) - l.a3 * std::cos(shoulder[1] + shoulder[2]);
      const bool possible = std::abs(along) < l.d5;
      if (possible) shoulder[3] = std::asin(along / l.d5) - shoulder[1] - shoulder[2];
      for (int kind = 0; kind < (possible ? 3 : 2); ++kind) {
        const Joints<double>& q = kind == 0 ? wrist : kind == 1 ? elbow : shoulder;
        const Pose<double> flange = chain.forward(q);
        const InverseSolutions<double> solutions = inverse(flange, q[5]);
        INFO("kind " << kind << " at " << distance);
        REQUIRE(solutions.count > 0);
        bool flagged = false;
        for (const InverseSolution<double>& s : solutions) {
          REQUIRE(apart(chain.forward(s.joints), flange) <= 1e-8);
          flagged |= kind == 0 ? s.wrist_singular : kind == 1 ? s.elbow_singular : s.shoulder_singular;
        }
        // Near a second singularity the rounding of the pose hides the distance to the first.
        Margins others = margins(q);
        (kind == 0 ? others.wrist : kind == 1 ? others.elbow : others.shoulder) = 1;
        if (distance < 0.9e-6 && others.least() > 1e-2) REQUIRE(flagged);
        if (distance >= 1e-5 && margins(q).least() >= 1e-5 && kind == 0)
          for (const InverseSolution<double>& s : solutions)
            if (turned_apart(s.joints, q) < 1e-4) REQUIRE_FALSE(s.wrist_singular);
      }
    }
  }
}

TEST_CASE("through q5 = pi with q6 held the nearest solution is one smooth motion") {
  const Chain<double> chain = ur5e_nominal<double>();
  Joints<double> q;
  q << 2.6, -1.2, -2.1, -1.4, M_PI - 0.1, 0.0;
  Joints<double> found = q;
  const int steps = 2000;  // the middle one is exactly at pi
  for (int i = 0; i <= steps; ++i) {
    q[4] = M_PI + 0.1 * (2.0 * i / steps - 1.0);
    const auto nearest = nearest_solution(inverse(chain.forward(q), found[5]), found);
    REQUIRE(nearest);
    REQUIRE((nearest->joints - found).cwiseAbs().maxCoeff() <= 1.5e-4);
    found = nearest->joints;
    REQUIRE((found - q).cwiseAbs().maxCoeff() <= 1e-6);
  }
}

TEST_CASE("the nearest solution stays on the seed's turn and inside the ranges") {
  const Chain<double> chain = ur5e_nominal<double>();
  Joints<double> q;
  q << 5.0, -4.0, 1.2, 5.5, -3.6, 6.0;  // none but the elbow within half a turn
  const InverseSolutions<double> solutions = inverse(chain.forward(q));
  const auto near = nearest_solution(solutions, q);
  REQUIRE(near);
  CHECK((near->joints - q).cwiseAbs().maxCoeff() <= 1e-9);

  // Joint 6 turns round twice: the angle goes on, up to the end of its range, and is then wound back.
  Joints<double> seed = q;
  double last = -2 * kPi;
  for (double angle = -2 * kPi; angle <= 2 * kPi; angle += 0.05) {
    q[5] = seed[5] = angle;
    const auto found = nearest_solution(inverse(chain.forward(q)), seed);
    REQUIRE(found);
    REQUIRE(found->joints[5] - last <= 0.051);
    last = found->joints[5];
  }
  Joints<double> beyond = q;
  beyond[5] = 2 * kPi + 0.3;
  REQUIRE(unwrap(beyond, beyond, kUr5eRanges));
  CHECK(beyond[5] == Approx(0.3));

  // A narrow range on the shoulder leaves the other branches, a range that holds none leaves nothing.
  JointRanges ranges = kUr5eRanges;
  ranges.lower[4] = 0.1;
  ranges.upper[4] = 3.0;
  const auto inside = nearest_solution(solutions, q, ranges);
  REQUIRE(inside);
  CHECK(ranges.contain(inside->joints));
  CHECK(apart(chain.forward(inside->joints), chain.forward([&] {
          Joints<double> original = q;
          original[5] = 6.0;
          return original;
        }())) <= 1e-12);
  ranges.lower[0] = 0.101;
  ranges.upper[0] = 0.102;
  CHECK_FALSE(nearest_solution(solutions, q, ranges));
}

TEST_CASE("single precision and derivatives go through") {
  Random random(15);
  const Chain<double> chain = ur5e_nominal<double>();
  const Chain<float> single = ur5e_nominal<float>();
  using D = Dual<double, 3>;
  for (int i = 0; i < 500; ++i) {
    const Joints<double> q = random_joints(random);
    if (margins(q).least() < 0.05) continue;
    const Pose<float> flange = single.forward(q.cast<float>());
    const InverseSolutions<float> found = inverse(flange);
    REQUIRE(found.count > 0);
    for (const InverseSolution<float>& s : found) {
      const Pose<float> again = single.forward(s.joints);
      REQUIRE((again.position - flange.position).norm() <= 2e-4F);
    }
    const Pose<double> pose = chain.forward(q);
    Pose<D> moving;
    for (int row = 0; row < 3; ++row) {
      moving.position[row] = D::variable(pose.position[row], row);
      for (int column = 0; column < 3; ++column) moving.rotation(row, column) = pose.rotation(row, column);
    }
    const Chain<D> dual = ur5e_nominal<D>();
    for (const InverseSolution<D>& s : inverse(moving)) {
      const Pose<D> again = dual.forward(s.joints);
      for (int row = 0; row < 3; ++row)
        for (int k = 0; k < 3; ++k)
          REQUIRE(std::abs(again.position[row].gradient[k] - (row == k ? 1.0 : 0.0)) <= 1e-6);
    }
  }
}

TEST_CASE("where the wrist is singular and q6 = 0 does not reach, another turn of it is found") {
  Random random(15);
  const Chain<double> chain = ur5e_nominal<double>();
  for (int i = 0; i < 20000; ++i) {
    Joints<double> q = random_joints(random);
    q[4] = std::array{-std::numbers::pi, 0.0, std::numbers::pi}[static_cast<std::size_t>(i % 3)];
    const Pose<double> flange = chain.forward(q);
    const InverseSolutions<double> solutions = inverse(flange);
    INFO("try " << i);
    REQUIRE(solutions.count > 0);
    for (const InverseSolution<double>& s : solutions)
      REQUIRE(apart(chain.forward(s.joints), flange) <= 1e-9);
  }
}
