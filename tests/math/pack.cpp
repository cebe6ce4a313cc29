// SPDX-License-Identifier: MIT
#include "diabolo/math/pack.hpp"

#include <Eigen/Dense>
#include <bit>
#include <limits>

#include "catch.hpp"
#include "random.hpp"

using namespace diabolo;

namespace {

template <class T>
bool same_bits(T a, T b) {
  using Integer = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  return std::bit_cast<Integer>(a) == std::bit_cast<Integer>(b);
}

template <class P>
using Number = ValueOf<P>;

/// A random number of any size and sign, or a special one.
template <class T>
T any_number(Random& random) {
  constexpr T kSpecial[] = {T(0),
                            T(-0.0),
                            T(1),
                            std::numeric_limits<T>::max(),
                            std::numeric_limits<T>::denorm_min(),
                            std::numeric_limits<T>::infinity(),
                            -std::numeric_limits<T>::infinity()};
  if (random.chance(0.2)) return kSpecial[random.index(7)];
  const double sign = random.chance(0.5) ? 1.0 : -1.0;
  return static_cast<T>(sign * random.log_uniform(1e-20, 1e20));
}

/// Calls `check(x, y)` with many pairs of packs.
template <class P, class Check>
void for_many(const Check& check) {
  Random random(4);
  for (int n = 0; n < 500; ++n) {
    P x, y;
    for (int i = 0; i < ScalarTraits<P>::kLanes; ++i) {
      x.set(i, any_number<Number<P>>(random));
      y.set(i, any_number<Number<P>>(random));
    }
    check(x, y);
  }
}

/// NaN has many bit patterns; IEEE leaves open which one an operation gives.
template <class T>
bool same(T a, T b) {
  return same_bits(a, b) || (a != a && b != b);
}

}  // namespace

using Double4 = Pack<double, 4>;
using Double2 = Pack<double, 2>;
using Double8 = Pack<double, 8>;
using Float8 = Pack<float, 8>;

TEMPLATE_TEST_CASE("each lane has the bits of the scalar operation", "", Double2, Double4, Double8, Float8) {
  for_many<TestType>([](const TestType& x, const TestType& y) {
    using T = Number<TestType>;
    const TestType sum = x + y, difference = x - y, product = x * y, quotient = x / y, negative = -x;
    const TestType root = sqrt(x), power = exp(x), logarithm = log(x), sine = sin(x), cosine = cos(x);
    TestType added = x, subtracted = x, multiplied = x, divided = x;
    added += y;
    subtracted -= y;
    multiplied *= y;
    divided /= y;
    bool good = true;
    for (int i = 0; i < ScalarTraits<TestType>::kLanes; ++i) {
      const T a = x[i], b = y[i];
      good = good && same<T>(sum[i], a + b) && same<T>(difference[i], a - b) && same<T>(product[i], a * b) &&
             same<T>(quotient[i], a / b) && same<T>(negative[i], -a) && same<T>(root[i], std::sqrt(a)) &&
             same<T>(power[i], std::exp(a)) && same<T>(logarithm[i], std::log(a)) &&
             same<T>(sine[i], std::sin(a)) && same<T>(cosine[i], std::cos(a)) && same<T>(added[i], sum[i]) &&
             same<T>(subtracted[i], difference[i]) && same<T>(multiplied[i], product[i]) &&
             same<T>(divided[i], quotient[i]);
    }
    CHECK(good);
  });
}

TEMPLATE_TEST_CASE("comparisons and choices go lane by lane", "", Double2, Double4, Double8, Float8) {
  for_many<TestType>([](const TestType& x, const TestType& y) {
    const auto less = x<y, greater = x> y, at_most = x <= y, at_least = x >= y, equal = x == y,
               other = x != y;
    const TestType chosen = select(less, x, y), low = minimum(x, y), size = absolute(x);
    bool some = false, every = true, good = true;
    for (int i = 0; i < ScalarTraits<TestType>::kLanes; ++i) {
      const auto a = x[i], b = y[i];
      good = good && less[i] == (a < b) && greater[i] == (a > b) && at_most[i] == (a <= b) &&
             at_least[i] == (a >= b) && equal[i] == (a == b) && other[i] == (a != b) &&
             same(chosen[i], a < b ? a : b) && same(low[i], a < b ? a : b) && same(size[i], a < 0 ? -a : a) &&
             (less && at_most)[i] == (a < b) && (less || equal)[i] == (a <= b) && (!less)[i] == !(a < b) &&
             is_finite(x)[i] == std::isfinite(a);
      some = some || a < b;
      every = every && a < b;
    }
    CHECK(good);
    CHECK(any(less) == some);
    CHECK(all(less) == every);
  });
}

TEST_CASE("NaN compares as in scalars") {
  const Float8 nan(std::numeric_limits<double>::quiet_NaN()), one(1.0);
  CHECK_FALSE(any(nan < one));
  CHECK_FALSE(any(nan >= one));
  CHECK_FALSE(any(nan == nan));
  CHECK(all(nan != nan));
  CHECK_FALSE(any(is_finite(nan)));
}

TEST_CASE("a mask made of one bool is the same in every lane") {
  using M = Double4::Mask;
  CHECK(all(M(true)));
  CHECK_FALSE(any(M(false)));
  CHECK_FALSE(any(M{}));
}

TEST_CASE("a lane does not feel its neighbours") {
  Random random(5);
  for (int n = 0; n < 100; ++n) {
    Double4 x(random.uniform(0.1, 2.0));
    const double mine = x[1];
    const auto f = [](const Double4& v) { return sqrt(v) / (Double4(1.0) + v * v) - exp(-v); };
    const double alone = f(x)[1];
    x.set(0, any_number<double>(random));
    x.set(2, std::numeric_limits<double>::quiet_NaN());
    REQUIRE(x[1] == mine);
    CHECK(same_bits(f(x)[1], alone));
  }
}

TEST_CASE("Eigen computes with packs") {
  Double4 x(2.0), y(3.0);
  x.set(1, 5.0);
  Eigen::Matrix<Double4, 2, 2> m;
  m << x, y, Double4(1.0), x;
  const Double4 determinant = m.determinant();
  CHECK(determinant[0] == 1.0);
  CHECK(determinant[1] == 22.0);
  const Vector3<Double4> v(x, y, x);
  CHECK(v.dot(v)[0] == 17.0);
  CHECK(v.dot(v)[1] == 59.0);
  CHECK(v.cross(v)[2][1] == 0.0);
  CHECK(v.squaredNorm()[1] == 59.0);
}
