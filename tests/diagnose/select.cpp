// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/select.hpp"

#include <cstddef>
#include <random>

#include "catch.hpp"
#include "diabolo/diagnose/findings.hpp"

using namespace diabolo;

namespace {

/// A random covariance of so many numbers.
Eigen::MatrixXd covariance(Eigen::Index n, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd root(n, n);
  for (Eigen::Index i = 0; i < root.size(); ++i) root(i) = normal(generator);
  return root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
}

}  // namespace

TEST_CASE("what lies in the box is not beyond it, and in a box of no size all is") {
  std::mt19937_64 generator(1);
  const Eigen::MatrixXd c = covariance(3, generator);
  const Eigen::VectorXd x = Eigen::Vector3d(0.5, -2.0, 1.0);
  CHECK(beyond_box(x, c, 2.0) == Approx(normal_equivalent(Eigen::VectorXd::Zero(3), c)));
  CHECK(beyond_box(x, c, 0.0) == Approx(normal_equivalent(x, c)));
}

TEST_CASE("no point of the box is nearer than the one that counts") {
  std::mt19937_64 generator(2);
  std::uniform_real_distribution<double> within(-1.0, 1.0), at(-4.0, 4.0);
  for (int trial = 0; trial < 50; ++trial) {
    CAPTURE(trial);
    const Eigen::Index n = 1 + trial % 6;
    const Eigen::MatrixXd c = covariance(n, generator);
    Eigen::VectorXd x(n), point(n);
    for (double& value : x) value = at(generator);
    const double beyond = beyond_box(x, c, 1.0);
    for (int draw = 0; draw < 2000; ++draw) {
      for (double& value : point) value = within(generator);
      REQUIRE(beyond <= normal_equivalent(x - point, c) + 1e-9);
    }
  }
}

TEST_CASE("one number alone that is weak does not carry others that are strong, but small") {
  // A centre: 5 +- 2 mm along the axle, and 0.2 +- 0.01 mm off it; the floor is 0.5 mm.
  const Candidate& marker = candidate_of("marker_offset");
  Estimates standing{UnknownVector::Zero(), Eigen::MatrixXd::Zero(kUnknowns, kUnknowns),
                     Eigen::MatrixXd::Zero(kUnknowns, kUnknowns)};
  constexpr int kX = index_of(Unknown::kMarkerX), kY = index_of(Unknown::kMarkerY);
  standing.estimate[kX] = 5e-3;
  standing.estimate[kY] = 2e-4;
  for (const Unknown u : marker.unknowns) standing.noise(index_of(u), index_of(u)) = 1e-10;
  standing.noise(kX, kX) = 4e-6;
  standing.spread = standing.noise;
  CHECK(speaks_for(marker, significance(marker, standing)));
  CHECK_FALSE(is_beyond_floor(marker, standing));
  standing.estimate[kY] = 6e-4;
  CHECK(is_beyond_floor(marker, standing));
}

TEST_CASE("findings can be sorted in buffers that are not aligned for SIMD") {
  STATIC_REQUIRE(alignof(Finding) <= alignof(std::max_align_t));
}
