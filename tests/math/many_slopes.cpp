// SPDX-License-Identifier: MIT
#include "diabolo/math/many_slopes.hpp"

#include <catch.hpp>
#include <limits>

#include "diabolo/math/dual.hpp"

using namespace diabolo;

namespace {

using Few = Dual<double, 2>;
using Many = Dual<double, 13>;  // not a whole number of registers
static_assert(!Few::kMany && Many::kMany);

Few few(double x, int index) { return Few::variable(x, index); }
Many many(double x, int index) { return Many::variable(x, 12 * index); }  // the first and the last

void check_same(const Many& a, const Few& b) {
  CHECK(a.value == b.value);
  CHECK(a.gradient[0] == b.gradient[0]);
  CHECK(a.gradient[12] == b.gradient[1]);
  for (int i = 1; i < 12; ++i) CHECK(a.gradient[i] == 0.0);
}

Vector3<Many> many_vector() { return {many(0.3, 0), Many(-2.0), many(1.7, 1)}; }
Vector3<Few> few_vector() { return {few(0.3, 0), Few(-2.0), few(1.7, 1)}; }

}  // namespace

TEST_CASE("many derivatives are what few are, bit for bit", "[many_slopes]") {
  const auto f = [](const auto& a, const auto& b) {
    using T = std::decay_t<decltype(a)>;
    return sqrt(a * a + b) / exp(a) - sin(b) * cos(-a) + tanh(a / b) * T(2.0) - atan2(a, T(0.5)) * log(b);
  };
  check_same(f(many(1.3, 0), many(0.7, 1)), f(few(1.3, 0), few(0.7, 1)));
  check_same(f(many(1.3, 0), Many(0.7)), f(few(1.3, 0), Few(0.7)));
  check_same(f(Many(1.3), many(0.7, 1)), f(Few(1.3), few(0.7, 1)));
  check_same(f(Many(1.3), Many(0.7)), f(Few(1.3), Few(0.7)));
}

TEST_CASE("vectors of many derivatives are what those of few are, bit for bit", "[many_slopes]") {
  const Vector3<Many> a = many_vector(), b = many_vector() * many(0.9, 1), c = a + b, d = a - b;
  const Vector3<Few> e = few_vector(), f = few_vector() * few(0.9, 1), g = e + f, h = e - f;
  for (int i = 0; i < 3; ++i) {
    check_same(b[i], f[i]);
    check_same(c[i], g[i]);
    check_same(d[i], h[i]);
  }
  check_same(dot(a, b), dot(e, f));
  check_same(squared_norm(a), squared_norm(e));
  const Vector3<Many> constants(Many(1.0), Many(2.0), Many(3.0));
  check_same(dot(a, constants), dot(e, Vector3<Few>(Few(1.0), Few(2.0), Few(3.0))));
  check_same(dot(constants, constants), Few(14.0));
}

TEST_CASE("zero is constant without derivatives, or with none that differ from zero", "[many_slopes]") {
  CHECK(is_constant_zero(Many(0.0)));
  CHECK_FALSE(is_constant_zero(Many(1.0)));
  CHECK_FALSE(is_constant_zero(many(0.0, 1)));
  CHECK(is_constant_zero(many(2.0, 1) * Many(0.0)));
  CHECK(is_constant_zero(constant(many(0.0, 1))));
  CHECK(is_constant_zero(many(2.0, 1) - many(2.0, 1)));
}

TEST_CASE("a constant has the value and no derivatives", "[many_slopes]") {
  check_same(constant(many(2.5, 0)), Few(2.5));
  CHECK(constant(2.5) == 2.5);
}

TEST_CASE("many derivatives are finite if each is", "[many_slopes]") {
  Many x = many(1.0, 0);
  CHECK(is_finite(x));
  x.gradient[12] = std::numeric_limits<double>::infinity();
  CHECK_FALSE(is_finite(x));
}

TEST_CASE("a copy has the derivatives, and a constant that is assigned has none", "[many_slopes]") {
  Many x = many(1.0, 0);
  const Many copy = x;
  x = Many(3.0);
  check_same(copy, few(1.0, 0));
  check_same(x, Few(3.0));
}
