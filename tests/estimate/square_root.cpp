// SPDX-License-Identifier: MIT
#include "diabolo/estimate/square_root.hpp"

#include <Eigen/LU>

#include "catch.hpp"
#include "random.hpp"

using namespace diabolo;

namespace {

template <int Rows, int Columns>
MatrixOf<Rows, Columns> random_matrix(Random& random) {
  MatrixOf<Rows, Columns> result;
  for (int i = 0; i < result.size(); ++i) result.data()[i] = random.uniform(-1.0, 1.0);
  return result;
}

/// What is the same for two matrices up to rounding.
template <class A, class B>
double difference(const A& a, const B& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

constexpr double kRounding = 1e-12;  // of some hundred operations on numbers of one

}  // namespace

TEST_CASE("a lower factor has the product of what it was made of") {
  const unsigned seed = 71;
  CAPTURE(seed);
  Random random(seed);
  for (int trial = 0; trial < 20; ++trial) {
    const MatrixOf<5, 9> a = random_matrix<5, 9>(random);
    const MatrixOf<5> lower = lower_factor<5, 9>(a);
    CHECK(difference(lower * lower.transpose(), a * a.transpose()) < kRounding);
    CHECK(lower.isLowerTriangular());
    CHECK(lower.diagonal().minCoeff() >= 0.0);
  }
}

TEST_CASE("sigma points have the mean and the covariance that they stand for, also after a linear map") {
  const unsigned seed = 72;
  CAPTURE(seed);
  Random random(seed);
  using Points = SigmaPoints<4>;
  const MatrixOf<4> factor = lower_factor<4, 4>(random_matrix<4, 4>(random));
  const MatrixOf<3, 4> map = random_matrix<3, 4>(random);
  const ColumnOf<3> shift = random_matrix<3, 1>(random);
  MatrixOf<3, Points::kCount> values;
  for (int i = 0; i < Points::kCount; ++i) values.col(i) = map * Points::offset(factor, i) + shift;
  CHECK(difference(Points::deviate(values), shift) < kRounding);
  const MatrixOf<3> expected = map * factor * factor.transpose() * map.transpose();
  CHECK(difference(values * values.transpose(), expected) < kRounding);
}

TEST_CASE("a linear measurement leaves what the Kalman filter leaves") {
  const unsigned seed = 73;
  CAPTURE(seed);
  Random random(seed);
  for (int trial = 0; trial < 20; ++trial) {
    const MatrixOf<5> factor = lower_factor<5, 5>(random_matrix<5, 5>(random));
    const MatrixOf<2, 5> measured = random_matrix<2, 5>(random);
    const MatrixOf<2> noise = lower_factor<2, 3>(random_matrix<2, 3>(random));
    const ColumnOf<2> innovation = random_matrix<2, 1>(random);
    const Correction<5> correction = condition<5, 2, 5>(factor, measured * factor, noise, innovation);
    const MatrixOf<5> before = factor * factor.transpose();
    const MatrixOf<2> spread = measured * before * measured.transpose() + noise * noise.transpose();
    const MatrixOf<5, 2> gain = before * measured.transpose() * spread.inverse();
    CHECK(difference(correction.shift, gain * innovation) < 1e-9);  // the inverse is not well conditioned
    CHECK(difference(correction.factor * correction.factor.transpose(), before - gain * measured * before) <
          1e-9);
    CHECK(correction.normalized_innovation_squared ==
          Approx(innovation.dot(spread.inverse() * innovation)).epsilon(1e-6));
  }
}

TEST_CASE("a covariance of what is known to the last digit stays one") {
  // Measured 1e8 times more sharply than known: the difference of covariances would not be positive.
  MatrixOf<3> factor = 1e4 * MatrixOf<3>::Identity();
  for (int i = 0; i < 100; ++i)
    factor = condition<3, 3, 3>(factor, factor, 1e-4 * MatrixOf<3>::Identity(), ColumnOf<3>::Zero()).factor;
  CHECK(factor.allFinite());
  CHECK(factor.diagonal().minCoeff() > 0.0);
  CHECK(factor(0, 0) == Approx(1e-5).epsilon(1e-6));  // a hundred readings
}
