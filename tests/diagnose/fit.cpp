// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/fit.hpp"

#include <Eigen/Cholesky>
#include <random>

#include "catch.hpp"

using namespace diabolo;

namespace {

/// A well conditioned quadratic in tilt, length scale and friction, whose minimum lies `far` scales away.
Normal quadratic(std::mt19937_64& generator, double far) {
  std::normal_distribution<double> normal;
  Normal result;
  result.free = {index_of(Unknown::kTiltX), index_of(Unknown::kLengthScale), index_of(Unknown::kFriction)};
  Eigen::Matrix3d root;
  for (double& x : root.reshaped()) x = normal(generator);
  result.information = root * root.transpose() + 0.2 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d minimum;
  for (double& x : minimum) x = far * normal(generator);
  result.score = result.information * minimum;
  return result;
}

double half_drop(const Normal& normal, const Eigen::VectorXd& step) {
  return normal.score.dot(step) - 0.5 * step.dot(normal.information * step);
}

bool in_bounds(const Normal& normal, const UnknownVector& at, const Eigen::VectorXd& step) {
  for (Eigen::Index i = 0; i < step.size(); ++i) {
    const int u = normal.free[static_cast<std::size_t>(i)];
    const UnknownInfo& info = info_of(static_cast<Unknown>(u));
    const double there = at[u] + step[i] * info.scale;
    if (there < info.minimum - 1e-12 || there > info.maximum + 1e-12) return false;
  }
  return true;
}

UnknownVector least_at(const UnknownVector& at) {
  return diagnose_detail::least_values(at, UnknownVector::Zero());
}

}  // namespace

TEST_CASE("a step that stays within bounds is Newton's") {
  std::mt19937_64 generator(11);
  const UnknownVector middle = UnknownVector::Constant(0.02), least = least_at(middle);
  const Normal normal = quadratic(generator, 0.1);
  const Eigen::VectorXd newton = normal.information.ldlt().solve(normal.score);
  REQUIRE(in_bounds(normal, middle, newton));
  CHECK((bounded_step(normal, middle, least, 0.0) - newton).norm() < 1e-12);
}

TEST_CASE("a step stays within bounds and what is free there is at its best") {
  std::mt19937_64 generator(12);
  const UnknownVector middle = UnknownVector::Constant(0.02), least = least_at(middle);
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    const Normal normal = quadratic(generator, 20.0);
    const Eigen::VectorXd step = bounded_step(normal, middle, least, 0.0);
    REQUIRE(in_bounds(normal, middle, step));
    const Eigen::VectorXd slope = normal.score - normal.information * step;
    for (Eigen::Index i = 0; i < 3; ++i) {
      Eigen::VectorXd moved = step;
      moved[i] += 1e-6;
      const bool up = in_bounds(normal, middle, moved);
      moved[i] -= 2e-6;
      if (up && in_bounds(normal, middle, moved)) CHECK(std::abs(slope[i]) < 1e-8);
    }
    CHECK(half_drop(normal, step) >= 0.0);
  }
}

TEST_CASE("damping shortens a step and keeps it downhill") {
  std::mt19937_64 generator(13);
  const UnknownVector middle = UnknownVector::Constant(0.02), least = least_at(middle);
  for (int trial = 0; trial < 50; ++trial) {
    const Normal normal = quadratic(generator, 0.1);
    double before = bounded_step(normal, middle, least, 0.0).norm();
    for (const double damping : {0.1, 1.0, 10.0, 100.0}) {
      const Eigen::VectorXd step = bounded_step(normal, middle, least, damping);
      if (damping > 1.0) CHECK(step.norm() < before);
      CHECK(half_drop(normal, step) > 0.0);
      before = step.norm();
    }
  }
}

TEST_CASE("nothing that is free makes no step") {
  Normal normal;
  normal.information.resize(0, 0);
  normal.score.resize(0);
  CHECK(bounded_step(normal, UnknownVector::Zero(), UnknownVector::Zero(), 0.0).size() == 0);
}
