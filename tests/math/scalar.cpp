// SPDX-License-Identifier: MIT
#include "diabolo/math/scalar.hpp"

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/math/pack.hpp"

using namespace diabolo;
using OneDual = Dual<double, 1>;
using P = Pack<double, 4>;

namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TEMPLATE_TEST_CASE("the contract's choices are made on the value", "", double, float, OneDual, P) {
  const TestType a(-2.0), b(3.0);
  CHECK(all(minimum(a, b) == a));
  CHECK(all(minimum(b, a) == a));
  CHECK(all(maximum(a, b) == b));
  CHECK(all(maximum(b, a) == b));
  CHECK(all(absolute(a) == TestType(2.0)));
  CHECK(all(absolute(b) == b));
  CHECK(all(select(Mask<TestType>(true), a, b) == a));
  CHECK(all(select(Mask<TestType>(false), a, b) == b));
}

TEMPLATE_TEST_CASE("a vector is chosen whole", "", double, float, OneDual, P) {
  const Vector3<TestType> a(TestType(1), TestType(2), TestType(3)), b(TestType(4), TestType(5), TestType(6));
  const Vector3<TestType> first = select<TestType>(Mask<TestType>(true), a, b);
  const Vector3<TestType> second = select<TestType>(Mask<TestType>(false), a, b);
  for (int i = 0; i < 3; ++i) {
    CHECK(all(first[i] == a[i]));
    CHECK(all(second[i] == b[i]));
  }
}

TEMPLATE_TEST_CASE("positive_sqrt is finite and nearly zero where its argument is not positive", "", double,
                   float) {
  CHECK(positive_sqrt(TestType(4)) == TestType(2));
  for (const TestType x : {TestType(0), TestType(-1)}) {
    CHECK(positive_sqrt(x) >= TestType(0));
    CHECK(positive_sqrt(x) < TestType(1e-15));
    CHECK(std::isfinite(TestType(1) / positive_sqrt(x)));
  }
}

TEST_CASE("norm and positive_sqrt have finite derivatives at zero") {
  const OneDual zero = OneDual::variable(0.0, 0);
  CHECK(std::isfinite(positive_sqrt(zero).gradient[0]));
  const Vector3<OneDual> nothing(zero, zero, zero);
  CHECK(std::isfinite(norm<OneDual>(nothing).gradient[0]));
  CHECK(norm<OneDual>(nothing).value < 1e-150);
}

TEST_CASE("norm agrees with Pythagoras to rounding") {
  CHECK(norm<double>({3.0, 4.0, 12.0}) == 13.0);
  CHECK(norm<float>({3.0F, 4.0F, 12.0F}) == 13.0F);
}

TEST_CASE("is_finite sees every fault") {
  for (const double x : {kNoNumber, kInfinity, -kInfinity}) {
    CHECK_FALSE(is_finite(x));
    CHECK_FALSE(is_finite(static_cast<float>(x)));
    CHECK_FALSE(is_finite(OneDual(x)));
    CHECK_FALSE(is_finite(OneDual(1.0, OneDual::Gradient::Constant(x))));
    P pack(1.0);
    pack.set(2, x);
    CHECK_FALSE(all(is_finite(pack)));
    CHECK(is_finite(pack)[0]);
    CHECK_FALSE(is_finite(pack)[2]);
  }
  CHECK(is_finite(1e308));
  CHECK(is_finite(OneDual(1.0)));
  CHECK(all(is_finite(P(-1e308))));
}

TEST_CASE("a constant zero has neither a lane nor a derivative that differs from zero") {
  CHECK(is_constant_zero(0.0));
  CHECK(is_constant_zero(-0.0F));
  CHECK_FALSE(is_constant_zero(1e-300));
  CHECK(is_constant_zero(OneDual(0.0)));
  CHECK_FALSE(is_constant_zero(OneDual(1e-300)));
  CHECK_FALSE(is_constant_zero(OneDual::variable(0.0, 0)));
  P pack(0.0);
  CHECK(is_constant_zero(pack));
  pack.set(3, 1.0);
  CHECK_FALSE(is_constant_zero(pack));
}

TEST_CASE("value_of drops derivatives") {
  CHECK(value_of(OneDual::variable(3.0, 0)) == 3.0);
  CHECK(value_of(2.0F) == 2.0F);
}

TEST_CASE("the constraint is solved more coarsely in single precision, above its rounding") {
  CHECK(constraint_tolerance<double>() == constraint_tolerance<P>());
  CHECK(constraint_tolerance<double>() == constraint_tolerance<OneDual>());
  CHECK(constraint_tolerance<float>() > 4.0 * double(std::numeric_limits<float>::epsilon()));
  CHECK(constraint_tolerance<float>() == constraint_tolerance<Pack<float, 8>>());
}
