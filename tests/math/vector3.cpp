// SPDX-License-Identifier: MIT
#include "diabolo/math/vector3.hpp"

#include "catch.hpp"
#include "random.hpp"

using diabolo::Vector3;

TEST_CASE("vector operators agree with Eigen's to the last bit") {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vector3<double> a = random.vector(10.0), b = random.vector(10.0);
    const double s = random.uniform(-3.0, 3.0);
    for (int k = 0; k < 3; ++k) {
      CHECK((diabolo::operator+(a, b))[k] == a[k] + b[k]);
      CHECK((diabolo::operator-(a, b))[k] == a[k] - b[k]);
      CHECK((diabolo::operator*(a, s))[k] == a[k] * s);
    }
    CHECK(diabolo::dot(a, b) == Approx(a.dot(b)).epsilon(1e-14).margin(1e-13));
    CHECK(diabolo::squared_norm(a) == Approx(a.squaredNorm()).epsilon(1e-14));
  }
}
