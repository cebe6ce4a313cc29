// SPDX-License-Identifier: MIT
#include "diabolo/sticks.hpp"

#include <limits>
#include <vector>

#include "catch.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/math/pack.hpp"
#include "random.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

struct Knots {
  std::vector<double> times;
  std::vector<Vector> left, right;
};

/// Instants at uneven distances, tips anywhere.
Knots random_knots(Random& random, std::size_t count) {
  Knots knots;
  double time = random.uniform(-2.0, 2.0);
  for (std::size_t i = 0; i < count; ++i) {
    knots.times.push_back(time);
    knots.left.push_back(random.vector(1.0));
    knots.right.push_back(random.vector(1.0));
    time += random.log_uniform(2e-3, 0.3);
  }
  return knots;
}

TipMotion<double> motion_of(const Knots& knots, Interpolation interpolation) {
  return {knots.times, knots.left, knots.right, interpolation};
}

double difference(const Tips<double>& a, const Tips<double>& b) {
  return (a.left - b.left).norm() + (a.right - b.right).norm();
}

constexpr Interpolation kAll[] = {Interpolation::kHeld, Interpolation::kLinear, Interpolation::kSpline};

}  // namespace

TEST_CASE("every interpolation goes through the knots") {
  Random random(30);
  for (const Interpolation interpolation : kAll)
    for (std::size_t count : {1U, 2U, 3U, 4U, 10U, 50U}) {
      const Knots knots = random_knots(random, count);
      const TipMotion<double> motion = motion_of(knots, interpolation);
      CHECK(motion.size() == count);
      CHECK(motion.begin() == knots.times.front());
      CHECK(motion.end() == knots.times.back());
      for (std::size_t i = 0; i < count; ++i) {
        CHECK((motion.at(knots.times[i]).left - knots.left[i]).norm() < 1e-14);
        CHECK((motion.at(knots.times[i]).right - knots.right[i]).norm() < 1e-14);
      }
    }
}

TEST_CASE("before the first and after the last instant the tips rest") {
  Random random(31);
  for (const Interpolation interpolation : kAll) {
    const Knots knots = random_knots(random, 5);
    const TipMotion<double> motion = motion_of(knots, interpolation);
    for (const double outside : {1e-9, 0.1, 1e6}) {
      const Tips<double> before = motion.at(knots.times.front() - outside);
      const Tips<double> after = motion.at(knots.times.back() + outside);
      CHECK(before.left == knots.left.front());
      CHECK(before.right == knots.right.front());
      CHECK(after.left == knots.left.back());
      CHECK(after.right == knots.right.back());
      for (const Tips<double>& tips : {before, after}) {
        CHECK(tips.left_velocity.isZero(0.0));
        CHECK(tips.right_velocity.isZero(0.0));
      }
    }
  }
}

TEST_CASE("held tips keep each pose until the next instant and have no velocity") {
  Random random(32);
  const Knots knots = random_knots(random, 6);
  const TipMotion<double> motion = motion_of(knots, Interpolation::kHeld);
  for (std::size_t i = 0; i + 1 < knots.times.size(); ++i)
    for (const double share : {0.0, 0.5, 1.0 - 1e-9}) {
      const Tips<double> tips = motion.at(knots.times[i] + share * (knots.times[i + 1] - knots.times[i]));
      CHECK(tips.left == knots.left[i]);
      CHECK(tips.right == knots.right[i]);
      CHECK(tips.left_velocity.isZero(0.0));
    }
}

TEST_CASE("linear and spline interpolation are exact for straight uniform motion") {
  Random random(33);
  const Vector start = random.vector(1.0), velocity = random.vector(2.0);
  Knots knots = random_knots(random, 8);
  for (std::size_t i = 0; i < 8; ++i) {
    knots.left[i] = start + velocity * knots.times[i];
    knots.right[i] = start - velocity * knots.times[i];
  }
  for (const Interpolation interpolation : {Interpolation::kLinear, Interpolation::kSpline}) {
    const TipMotion<double> motion = motion_of(knots, interpolation);
    for (int i = 0; i < 100; ++i) {
      const double time = random.uniform(motion.begin(), motion.end());
      const Tips<double> tips = motion.at(time);
      CHECK((tips.left - start - velocity * time).norm() < 1e-13);
      // Positions of order 1 m, rounded to 1e-16, over instants that may be 2 ms apart.
      CHECK((tips.left_velocity - velocity).norm() < 1e-11);
      CHECK((tips.right_velocity + velocity).norm() < 1e-11);
    }
  }
}

TEST_CASE("the velocity is the derivative of the position") {
  Random random(34);
  for (const Interpolation interpolation : {Interpolation::kLinear, Interpolation::kSpline}) {
    const Knots knots = random_knots(random, 12);
    const TipMotion<double> motion = motion_of(knots, interpolation);
    for (std::size_t i = 0; i + 1 < knots.times.size(); ++i) {
      const double h = knots.times[i + 1] - knots.times[i], time = knots.times[i] + 0.37 * h, d = 1e-4 * h;
      const Tips<double> tips = motion.at(time), up = motion.at(time + d), down = motion.at(time - d);
      // Cubic pieces: the central difference errs by the third derivative times d^2 / 6, about 1e-7 relative.
      const double margin = 1e-6 * (1.0 + tips.left_velocity.norm() + 1.0 / h);
      CHECK((tips.left_velocity - (up.left - down.left) / (2.0 * d)).norm() < margin);
      CHECK((tips.right_velocity - (up.right - down.right) / (2.0 * d)).norm() < margin);
    }
  }
}

TEST_CASE(
    "at an instant between two straight lines the tips move as they came, on either side of its rounding") {
  const std::vector<double> times{0.0, 0.3, 0.5};
  const std::vector<Vector> left{{0.0, 0.3, 1.0}, {0.0, 0.3, 1.3}, {0.0, 0.3, 0.9}};
  const TipMotion<double> motion(times, left, left, Interpolation::kLinear);
  for (const double time : {std::nextafter(0.3, 0.0), 0.3, 0.1 * 3.0}) {
    CHECK(motion.at(time).left_velocity.z() == Approx(1.0));
    CHECK(motion.at(time).left.z() == Approx(1.3));
  }
  CHECK(motion.at(0.0).left_velocity.z() == Approx(1.0));
  CHECK(motion.at(0.301).left_velocity.z() == Approx(-2.0));
  std::size_t hint = 1;
  CHECK(motion.at(0.3, hint).left_velocity.z() == Approx(1.0));
}

TEST_CASE("the last instant still moves, on either side of its rounding") {
  const std::vector<double> times{0.0, 0.1 * 3.0};
  const std::vector<Vector> left{{0.0, 0.3, 1.0}, {0.0, 0.3, 1.3}}, right{{0.0, -0.3, 1.0}, {0.0, -0.3, 1.3}};
  for (const Interpolation interpolation : {Interpolation::kLinear, Interpolation::kSpline}) {
    const TipMotion<double> motion(times, left, right, interpolation);
    for (const double time : {0.3, motion.end(), std::nextafter(motion.end(), 1.0)}) {
      CHECK((motion.at(time).left - left.back()).norm() < 1e-15);
      CHECK(std::abs(motion.at(time).left_velocity.z() - 1.0) < 1e-12);
    }
    CHECK(std::abs(motion.at(-1e-17).right_velocity.z() - 1.0) < 1e-12);
  }
}

TEST_CASE("the spline is natural: continuous velocity and acceleration, none at the ends") {
  Random random(35);
  const Knots knots = random_knots(random, 9);
  const TipMotion<double> motion = motion_of(knots, Interpolation::kSpline);
  // Within a piece the velocity is a parabola: three values give its rate at the edge exactly.
  const auto rate_at_edge = [&](double edge, double towards) {
    const auto v = [&](double t) { return motion.at(edge + t).left_velocity; };
    const double h = towards;
    return Vector((-3.0 * v(1e-9 * h) + 4.0 * v(0.25 * h) - v(0.5 * h)) / (0.5 * h));
  };
  double largest = 0.0;
  for (std::size_t i = 0; i < knots.times.size(); ++i) {
    const double time = knots.times[i];
    const bool first = i == 0, last = i + 1 == knots.times.size();
    const Vector before = first ? Vector(Vector::Zero()) : rate_at_edge(time, knots.times[i - 1] - time);
    const Vector after = last ? Vector(Vector::Zero()) : rate_at_edge(time, knots.times[i + 1] - time);
    largest = std::max(largest, before.norm());
    CHECK((before - after).norm() < 1e-6 * (1.0 + largest));
    if (first || last) continue;
    const double tick = 1e-10;
    const Vector velocity_before = motion.at(time - tick).left_velocity;
    CHECK((velocity_before - motion.at(time).left_velocity).norm() < 1e-9 * (1.0 + largest));
  }
  CHECK(largest > 1.0);
}

TEST_CASE("a spline through a smooth motion converges with the fourth power of the distance of its knots") {
  const auto error = [](int count) {
    Knots knots;
    const double h = 2.0 * M_PI / count;
    for (int i = -count; i <= 2 * count; ++i) {  // wide margins: natural ends do not fit the sine
      knots.times.push_back(i * h);
      knots.left.emplace_back(std::sin(i * h), std::cos(i * h), 0.0);
      knots.right.emplace_back(0.0, 0.0, std::sin(i * h));
    }
    const TipMotion<double> motion = motion_of(knots, Interpolation::kSpline);
    double worst = 0.0;
    for (double t = 0.0; t < 2.0 * M_PI; t += 0.01)
      worst = std::max(worst, (motion.at(t).left - Vector(std::sin(t), std::cos(t), 0.0)).norm());
    return worst;
  };
  CHECK(error(32) < 2e-5);
  CHECK(error(32) / error(64) == Approx(16.0).epsilon(0.15));
}

TEST_CASE("the hint changes nothing, in whatever order the motion is read") {
  Random random(36);
  for (const Interpolation interpolation : kAll) {
    const Knots knots = random_knots(random, 20);
    const TipMotion<double> motion = motion_of(knots, interpolation);
    std::size_t hint = 1000;  // of some longer motion
    for (int i = 0; i < 500; ++i) {
      const double time = random.uniform(motion.begin() - 0.1, motion.end() + 0.1);
      CHECK(difference(motion.at(time, hint), motion.at(time)) == 0.0);
    }
  }
}

TEST_CASE("sticks are of unit length at every time, and point as given at the instants") {
  Random random(37);
  for (const Interpolation interpolation : kAll) {
    const Knots knots = random_knots(random, 20);
    std::vector<Vector> left, right;
    for (std::size_t i = 0; i < 20; ++i) {
      left.push_back(random.vector(1.0).normalized());
      right.push_back(random.vector(1.0).normalized());
    }
    TipMotion<double> motion = motion_of(knots, interpolation);
    motion.point_along(left, right);
    for (std::size_t i = 0; i < 20; ++i) {
      CHECK((motion.at(knots.times[i]).left_direction - left[i]).norm() < 1e-14);
      CHECK(motion.pose(i).right_direction == right[i]);
    }
    for (int i = 0; i < 200; ++i) {
      const Tips<double> tips = motion.at(random.uniform(motion.begin() - 0.1, motion.end() + 0.1));
      CHECK(std::abs(tips.left_direction.norm() - 1.0) < 1e-14);
      CHECK(std::abs(tips.right_direction.norm() - 1.0) < 1e-14);
    }
    motion.point_along(left, std::vector<Vector>(20, Vector::Zero()));
    CHECK(motion.at(0.5 * (knots.times[3] + knots.times[4])).right_direction.isZero(0.0));
  }
}

TEST_CASE("bad input is refused in a sentence") {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  const Vector p(0.0, 0.0, 1.0);
  const auto build = [&](std::vector<double> times, std::vector<Vector> left, std::vector<Vector> right) {
    return TipMotion<double>(std::move(times), left, right, Interpolation::kSpline);
  };
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(build({}, {}, {}), Contains("no instants") && Contains("at least one"));
  CHECK_THROWS_WITH(build({0.0, 1.0}, {p, p}, {p}), Contains("2 times") && Contains("1 right tips"));
  CHECK_THROWS_WITH(build({0.0, 1.0}, {p}, {p, p}), Contains("1 left tips"));
  CHECK_THROWS_WITH(build({0.0, 1.0, 1.0}, {p, p, p}, {p, p, p}), Contains("instant 2") && Contains("after"));
  CHECK_THROWS_WITH(build({0.0, -1.0}, {p, p}, {p, p}), Contains("instant 1"));
  CHECK_THROWS_WITH(build({0.0, nan}, {p, p}, {p, p}), Contains("instant 1") && Contains("finite"));
  CHECK_THROWS_WITH(build({-infinity, 0.0}, {p, p}, {p, p}), Contains("instant 0"));
  CHECK_THROWS_WITH(build({0.0, 1.0}, {p, {0.0, nan, 0.0}}, {p, p}),
                    Contains("instant 1") && Contains("tip"));
  CHECK_THROWS_WITH(build({0.0, 1.0}, {p, p}, {{infinity, 0.0, 0.0}, p}), Contains("instant 0"));
  CHECK_THROWS_AS(build({}, {}, {}), std::invalid_argument);
  TipMotion<double> motion = build({0.0, 1.0}, {p, p}, {p, p});
  CHECK_THROWS_WITH(motion.point_along({p, p}, {p}), Contains("1 right directions"));
  for (const Vector& bad : {Vector(0.0, nan, 0.0), Vector(0.0, 0.0, infinity), Vector(0.0, 0.0, 1.00001)})
    CHECK_THROWS_WITH(motion.point_along({p, p}, {p, bad}), Contains("instant 1: a direction"));
}

TEST_CASE("tips may carry derivatives and lanes") {
  using D = Dual<double, 1>;
  const Vector3<D> still(D(0.0), D(0.0), D(0.0)), moved(D::variable(2.0, 0), D(0.0), D(0.0));
  const TipMotion<D> motion({0.0, 1.0, 2.0}, {still, moved, still}, {still, still, still},
                            Interpolation::kSpline);
  // The natural spline through (0, x, 0) is x (3 t - t^3) / 2 for t < 1: its derivative with x is the shape.
  CHECK(motion.at(0.5).left.x().value == Approx(2.0 * (1.5 - 0.125) / 2.0));
  CHECK(motion.at(0.5).left.x().gradient[0] == Approx((1.5 - 0.125) / 2.0));
  CHECK(motion.at(0.5).left_velocity.x().gradient[0] == Approx((3.0 - 3.0 * 0.25) / 2.0));

  using P = Pack<double, 4>;
  P x(1.0);
  x.set(2, -3.0);
  const Vector3<P> none(P(0.0), P(0.0), P(0.0)), there(x, P(0.0), P(0.0));
  const TipMotion<P> packed({0.0, 1.0}, {none, there}, {none, none}, Interpolation::kLinear);
  CHECK(packed.at(0.25).left.x()[0] == 0.25);
  CHECK(packed.at(0.25).left.x()[2] == -0.75);
}
