// SPDX-License-Identifier: MIT
#include "diabolo/math/lane_functions.hpp"

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "diabolo/math/pack.hpp"
#include "random.hpp"

using namespace diabolo;

namespace {

using Double4 = Pack<double, 4>;
using Double8 = Pack<double, 8>;
using Float8 = Pack<float, 8>;

/// How many units in the last place of `exact` the value is away; a wrong sign of zero counts as many.
template <class T>
double units_off(T value, double exact) {
  if (std::isnan(exact)) return std::isnan(value) ? 0.0 : INFINITY;
  if (std::signbit(value) != std::signbit(exact)) return INFINITY;
  const T size = std::abs(static_cast<T>(exact));
  const T unit = std::nextafter(size, std::numeric_limits<T>::infinity()) - size;
  return std::abs(static_cast<double>(value) - exact) / static_cast<double>(unit);
}

/// Of any size that a law has, and a special one now and then.
template <class T>
T argument_of_a_law(Random& random) {
  constexpr double kSpecial[] = {0.0,
                                 -0.0,
                                 1.0,
                                 20.0,
                                 std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::quiet_NaN()};
  if (random.chance(0.1)) return static_cast<T>(kSpecial[random.index(7)]);
  if (random.chance(0.5)) return static_cast<T>(random.uniform(-22.0, 22.0));
  return static_cast<T>((random.chance(0.5) ? 1.0 : -1.0) * random.log_uniform(1e-18, 1e18));
}

}  // namespace

TEMPLATE_TEST_CASE("tanh and atan2 of lanes are the C library's to some units in the last place", "", Double4,
                   Double8, Float8) {
  using T = ValueOf<TestType>;
  Random random(5);
  double worst_tangent = 0.0, worst_angle = 0.0;
  for (int n = 0; n < 20'000; ++n) {
    TestType x, y;
    for (int i = 0; i < ScalarTraits<TestType>::kLanes; ++i) {
      x.set(i, argument_of_a_law<T>(random));
      y.set(i, argument_of_a_law<T>(random));
    }
    const TestType tangent = tanh(x), angle = atan2(y, x);
    for (int i = 0; i < ScalarTraits<TestType>::kLanes; ++i) {
      const double a = static_cast<double>(x[i]), b = static_cast<double>(y[i]);
      worst_tangent = std::max(worst_tangent, units_off<T>(tangent[i], std::tanh(a)));
      worst_angle = std::max(worst_angle, units_off<T>(angle[i], std::atan2(b, a)));
    }
  }
  // What the header says, and one unit in which the C library may be wrong.
  CHECK(worst_tangent <= 3.0);
  CHECK(worst_angle <= 7.0);
}

TEST_CASE("a lane's tanh does not depend on its neighbours") {
  Double4 mixed, alike(0.3);
  mixed.set(0, 0.3);
  mixed.set(1, 3.0);
  mixed.set(2, -30.0);
  CHECK(tanh(mixed)[0] == tanh(alike)[0]);
}
