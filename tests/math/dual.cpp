// SPDX-License-Identifier: MIT
#include "diabolo/math/dual.hpp"

#include <Eigen/Dense>
#include <complex>

#include "catch.hpp"
#include "diabolo/math/pack.hpp"
#include "random.hpp"

using namespace diabolo;
using D = Dual<double, 2>;
using Complex = std::complex<double>;

namespace {

D variable(double x, int index) { return D::variable(x, index); }

/// Derivative by central differences, extrapolated once (Richardson): error of order step^4.
template <class Function>
double difference(const Function& f, double x, double y, int index) {
  const auto central = [&](double h) {
    const double dx = index == 0 ? h : 0.0, dy = index == 1 ? h : 0.0;
    return (f(x + dx, y + dy) - f(x - dx, y - dy)) / (2.0 * h);
  };
  const double h = 1e-3;
  return (4.0 * central(0.5 * h) - central(h)) / 3.0;
}

/// Derivative by a complex step: no subtraction, so exact to rounding.
template <class Function>
double complex_step(const Function& f, double x, double y, int index) {
  const double h = 1e-30;
  return f(Complex(x, index == 0 ? h : 0.0), Complex(y, index == 1 ? h : 0.0)).imag() / h;
}

/// Both checks of one function of two variables, at random points.
template <class Function>
void check_derivatives(const char* name, const Function& f) {
  INFO(name);
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const double x = random.uniform(0.3, 2.0), y = random.uniform(0.3, 2.0);
    const D result = f(variable(x, 0), variable(y, 1));
    CHECK(result.value == Approx(f(x, y)).epsilon(1e-15).margin(1e-15));
    for (int k = 0; k < 2; ++k) {
      CAPTURE(x, y, k);
      // Third differences of these functions are below 1e2: (1e-3)^4 * 1e2 and rounding 1e-16 / 1e-3.
      CHECK(result.gradient[k] == Approx(difference(f, x, y, k)).epsilon(1e-9).margin(1e-10));
      CHECK(result.gradient[k] == Approx(complex_step(f, x, y, k)).epsilon(1e-14).margin(1e-14));
    }
  }
}

}  // namespace

TEST_CASE("every operation's derivative agrees with differences and with a complex step") {
  check_derivatives("-x", [](auto x, auto) { return -x; });
  check_derivatives("x + y", [](auto x, auto y) { return x + y; });
  check_derivatives("x - y", [](auto x, auto y) { return x - y; });
  check_derivatives("x * y", [](auto x, auto y) { return x * y; });
  check_derivatives("x / y", [](auto x, auto y) { return x / y; });
  check_derivatives("sqrt", [](auto x, auto y) { return sqrt(x * x + y); });
  check_derivatives("exp", [](auto x, auto y) { return exp(x - y * y); });
  check_derivatives("sin", [](auto x, auto y) { return sin(x * y); });
  check_derivatives("cos", [](auto x, auto y) { return cos(x / y); });
  check_derivatives("log", [](auto x, auto y) { return log(x * x + y * y); });
  check_derivatives("tanh", [](auto x, auto y) { return tanh(x * y - x); });
  check_derivatives("with constants", [](auto x, auto y) {
    using T = decltype(x);
    T z = T(2.0) * x + T(1.0);
    z += y;
    z -= x * y;
    z *= y;
    z /= x;
    return z;
  });
}

TEST_CASE("atan2 has the right derivatives in every quadrant") {
  using std::atan2;
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const double angle = random.uniform(-3.0, 3.0), radius = random.uniform(0.5, 2.0);
    const double y = radius * std::sin(angle), x = radius * std::cos(angle);
    const D result = atan2(variable(y, 0), variable(x, 1));
    const auto f = [](double a, double b) { return std::atan2(a, b); };
    CHECK(result.value == std::atan2(y, x));
    CHECK(result.gradient[0] == Approx(difference(f, y, x, 0)).margin(1e-9));
    CHECK(result.gradient[1] == Approx(difference(f, y, x, 1)).margin(1e-9));
  }
}

TEST_CASE("comparisons and choices look at the value and keep its derivatives") {
  const D x = variable(1.0, 0), y = variable(2.0, 1), same(1.0);
  CHECK(x < y);
  CHECK(y > x);
  CHECK(x <= same);
  CHECK(x >= same);
  CHECK(x == same);
  CHECK(x != y);
  CHECK(maximum(x, y).gradient[1] == 1.0);
  CHECK(minimum(x, y).gradient[0] == 1.0);
  CHECK(absolute(-x).gradient[0] == 1.0);
}

TEST_CASE("a choice does not let the other side's NaN through") {
  const D zero = variable(0.0, 0), root = sqrt(zero);
  REQUIRE_FALSE(is_finite(root));
  CHECK(is_finite(select(false, root, D(1.0))));
}

TEST_CASE("Eigen computes with duals") {
  using Matrix2 = Eigen::Matrix<D, 2, 2>;
  const D x = variable(0.3, 0), y = variable(1.7, 1);
  Matrix2 m;
  m << x, y, y, x * y;
  const D determinant = m.determinant();  // x^2 y - y^2
  CHECK(determinant.value == Approx(0.3 * 0.3 * 1.7 - 1.7 * 1.7));
  CHECK(determinant.gradient[0] == Approx(2.0 * 0.3 * 1.7));
  CHECK(determinant.gradient[1] == Approx(0.3 * 0.3 - 2.0 * 1.7));

  const Vector3<D> a(x, y, D(1.0)), b(y, D(2.0), x);
  const D product = a.dot(b);  // 2 x y + 2 y... by components: x y + 2 y + x
  CHECK(product.gradient[0] == Approx(1.7 + 1.0));
  CHECK(product.gradient[1] == Approx(0.3 + 2.0));
  CHECK(a.norm().gradient[0] == Approx(0.3 / std::sqrt(0.3 * 0.3 + 1.7 * 1.7 + 1.0)));
  const Vector3<D> cross = Vector3<D>(a + b * D(2.0)).cross(b);
  CHECK(cross[0].value == Approx((1.7 + 4.0) * 0.3 - 1.6 * 2.0));
  CHECK((m * m.inverse())(0, 1).gradient[0] == Approx(0.0).margin(1e-14));
}

TEST_CASE("duals over packs carry a derivative per lane") {
  using P = Pack<double, 4>;
  using DP = Dual<P, 2>;
  P x, y;
  for (int i = 0; i < 4; ++i) {
    x.set(i, 0.5 + i);
    y.set(i, 2.0 - 0.3 * i);
  }
  const auto f = [](auto a, auto b) { return sqrt(a * a + b) / exp(a) + sin(b) * cos(a) - tanh(a / b); };
  const DP result = f(DP::variable(x, 0), DP::variable(y, 1));
  for (int i = 0; i < 4; ++i) {
    const D lane = f(variable(x[i], 0), variable(y[i], 1));
    CHECK(result.value[i] == lane.value);
    for (int k = 0; k < 2; ++k) CHECK(result.gradient[k][i] == Approx(lane.gradient[k]).epsilon(1e-15));
  }
  const DP chosen = maximum(DP::variable(x, 0), DP::variable(y, 1));
  for (int i = 0; i < 4; ++i) CHECK(chosen.gradient[0][i] == (x[i] > y[i] ? 1.0 : 0.0));
}

TEST_CASE("a dual in single precision agrees with one in double precision") {
  using F = Dual<float, 1>;
  const F x = F::variable(1.3F, 0);
  const Dual<double, 1> exact = Dual<double, 1>::variable(double(1.3F), 0);
  const F single = sqrt(x) * exp(-x) / (F(1.0) + x * x);
  const Dual<double, 1> wide = sqrt(exact) * exp(-exact) / (Dual<double, 1>(1.0) + exact * exact);
  CHECK(double(single.gradient[0]) == Approx(wide.gradient[0]).epsilon(1e-5));
}

TEST_CASE("derivatives may be shorter than the value, which stays as exact as without them") {
  using M = Dual<double, 2, float>;
  const auto f = [](const auto& a, const auto& b) {
    using T = std::decay_t<decltype(a)>;
    return sqrt(a * a + b) / exp(a) + sin(b) * cos(a) - tanh(a / b) + atan2(a, b) * T(2.0);
  };
  const M mixed = f(M::variable(1.3, 0), M::variable(0.7, 1));
  const D wide = f(variable(1.3, 0), variable(0.7, 1));
  CHECK(mixed.value == wide.value);
  for (int k = 0; k < 2; ++k)
    CHECK(static_cast<double>(mixed.gradient[k]) == Approx(wide.gradient[k]).epsilon(1e-5));
}

TEST_CASE("a slope beyond the range of short derivatives leaves those that are zero at zero") {
  using M = Dual<double, 2, float>;
  const M steep = M(1.0) / M::variable(1e-60, 0);
  CHECK(steep.gradient[1] == 0.0F);
  CHECK(std::isfinite(steep.gradient[0]));
}
