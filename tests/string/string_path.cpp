// SPDX-License-Identifier: MIT
#include "diabolo/string/string_path.hpp"

#include "catch.hpp"
#include "diabolo/math/pack.hpp"
#include "random.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

Tips<double> random_tips(Random& random) {
  return {random.vector(1.0), random.vector(1.0), random.vector(2.0), random.vector(2.0)};
}

Tips<double> moved(const Tips<double>& tips, double time) {
  return {Vector(tips.left + tips.left_velocity * time), Vector(tips.right + tips.right_velocity * time),
          tips.left_velocity, tips.right_velocity};
}

}  // namespace

TEST_CASE("a path is two strands from the tips to the diabolo") {
  Random random(60);
  for (int i = 0; i < 100; ++i) {
    const Tips<double> tips = random_tips(random);
    const Vector diabolo = random.vector(1.0);
    const StringPath<double> path(diabolo, tips);
    const double left = (diabolo - tips.left).norm(), right = (diabolo - tips.right).norm();
    CHECK(path.left_length == Approx(left));
    CHECK(path.right_length == Approx(right));
    CHECK(path.length() == Approx(left + right));
    CHECK(path.imbalance() == Approx(right - left).margin(1e-14));
  }
}

TEST_CASE("gradient and rates are the derivatives of the length") {
  Random random(61);
  for (int i = 0; i < 200; ++i) {
    const Tips<double> tips = random_tips(random);
    const Vector diabolo = random.vector(1.0), velocity = random.vector(2.0);
    const StringPath<double> path(diabolo, tips);
    if (path.left_length < 0.1 || path.right_length < 0.1) continue;
    const double h = 1e-5;  // speeds up to 5 m/s, strands above 0.1 m: error (5 h / 0.1)^2 * 5 = 1e-6
    const auto length = [&](const Vector& p, double t) {
      return StringPath<double>(p, moved(tips, t)).length();
    };
    for (int k = 0; k < 3; ++k) {
      const Vector step = Vector::Unit(k) * h;
      CHECK(path.gradient()[k] ==
            Approx((length(diabolo + step, 0.0) - length(diabolo - step, 0.0)) / (2.0 * h)).margin(1e-6));
    }
    const double tip_rate = (length(diabolo, h) - length(diabolo, -h)) / (2.0 * h);
    CHECK(path.tip_rate(tips.left_velocity, tips.right_velocity) == Approx(tip_rate).margin(1e-5));
    const double rate = (length(diabolo + velocity * h, h) - length(diabolo - velocity * h, -h)) / (2.0 * h);
    CHECK(path.rate(velocity, tips.left_velocity, tips.right_velocity) == Approx(rate).margin(1e-5));
  }
}

TEST_CASE("the discrete gradient's product with a displacement is exactly the change of the length") {
  Random random(62);
  for (int i = 0; i < 500; ++i) {
    const Tips<double> tips = random_tips(random);
    const Vector from = random.vector(1.0), to = from + random.arrow(1e-9, 2.0);
    const StringPath<double> a(from, tips), b(to, tips);
    const double change = discrete_gradient(a, b).dot(to - from);
    CHECK(change == Approx(b.length() - a.length()).epsilon(0).margin(4e-15));  // rounding of lengths of 1 m
    CHECK((discrete_gradient(a, b) - discrete_gradient(b, a)).norm() == 0.0);
  }
}

TEST_CASE("the discrete gradient of a short way is the gradient at its middle, to second order") {
  Random random(63);
  for (int i = 0; i < 100; ++i) {
    const Tips<double> tips = random_tips(random);
    const Vector middle = random.vector(1.0), direction = random.direction();
    const StringPath<double> path(middle, tips);
    if (path.left_length < 0.2 || path.right_length < 0.2) continue;
    const auto error = [&](double h) {
      const StringPath<double> a(middle - direction * h, tips), b(middle + direction * h, tips);
      return (discrete_gradient(a, b) - path.gradient()).norm();
    };
    CHECK(error(1e-2) < 1e-2 * 1e-2 / (0.2 * 0.2) * 2.0);
    CHECK(error(1e-3) <= error(1e-2) * 0.011 + 1e-15);
  }
}

TEST_CASE("a diabolo at a tip and coinciding tips give finite numbers") {
  const Vector p(0.1, 0.2, 0.3), q(0.5, 0.2, 0.3), none = Vector::Zero();
  for (const Tips<double>& tips : {Tips<double>{p, q, none, none}, Tips<double>{p, p, none, none}}) {
    const StringPath<double> path(p, tips);
    CHECK(path.gradient().allFinite());
    CHECK(std::isfinite(path.rate(q, q, p)));
    CHECK(discrete_gradient(path, path).allFinite());
  }
}

TEST_CASE("chosen lanes are taken from another path") {
  using P = Pack<double, 4>;
  const Vector3<P> zero(P(0.0), P(0.0), P(0.0)), one(P(1.0), P(0.0), P(0.0)), two(P(2.0), P(0.0), P(0.0));
  const Tips<P> tips{one, two, zero, zero};
  StringPath<P> path(zero, tips);
  const StringPath<P> other(Vector3<P>(P(5.0), P(0.0), P(0.0)), tips);
  P lane;
  for (int i = 0; i < 4; ++i) lane.set(i, i);
  path.keep_where(lane > P(1.5), other);
  CHECK(path.left_length[1] == 1.0);
  CHECK(path.left_length[2] == 4.0);
  CHECK(path.from_right.x()[0] == -2.0);
  CHECK(path.from_right.x()[3] == 3.0);
}
