// SPDX-License-Identifier: MIT
#include "diabolo/math/cubic_spline.hpp"

#include "catch.hpp"
#include "random.hpp"

using namespace diabolo;
using Column = Eigen::Matrix<double, 2, 1>;

namespace {

struct Knots {
  std::vector<double> times, steps;

  explicit Knots(Random& random, int count) {
    for (double time = 0.0; static_cast<int>(times.size()) < count; time += random.uniform(0.05, 0.4))
      times.push_back(time);
    for (std::size_t i = 0; i + 1 < times.size(); ++i) steps.push_back(times[i + 1] - times[i]);
  }
};

Column cubic(double t) { return {1.0 + 2.0 * t - 3.0 * t * t + 0.5 * t * t * t, t * t * t}; }
Column cubic_rate(double t) { return {2.0 - 6.0 * t + 1.5 * t * t, 3.0 * t * t}; }

}  // namespace

TEST_CASE("a clamped spline through a cubic is that cubic") {
  Random random(5);
  for (const int count : {2, 3, 7, 40}) {
    const Knots knots(random, count);
    std::vector<Column> values;
    for (const double t : knots.times) values.push_back(cubic(t));
    const std::vector<Column> m =
        spline_curvatures(knots.steps, values,
                          std::optional(EndSlopes<Column>{cubic_rate(0.0), cubic_rate(knots.times.back())}));
    const double size = cubic(knots.times.back()).norm() + 1.0;
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
      const SplinePoint<Column> middle =
          spline_point(values[i], values[i + 1], m[i], m[i + 1], knots.steps[i], 0.3);
      const double t = knots.times[i] + 0.3 * knots.steps[i];
      CHECK((middle.value - cubic(t)).norm() < 1e-12 * size);
      CHECK((middle.rate - cubic_rate(t)).norm() < 1e-11 * size);
    }
  }
}

TEST_CASE("a natural spline has no curvature at its ends and one velocity at each knot") {
  Random random(6);
  const Knots knots(random, 20);
  std::vector<Column> values;
  for (std::size_t i = 0; i < knots.times.size(); ++i)
    values.push_back({random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)});
  const std::vector<Column> m = spline_curvatures(knots.steps, values);
  CHECK(m.front() == Column::Zero());
  CHECK(m.back() == Column::Zero());
  for (std::size_t i = 1; i + 1 < values.size(); ++i) {
    const auto at = [&](std::size_t k, double v) {
      return spline_point(values[k], values[k + 1], m[k], m[k + 1], knots.steps[k], v);
    };
    CHECK((at(i - 1, 1.0).value - values[i]).norm() < 1e-14);
    CHECK((at(i - 1, 1.0).rate - at(i, 0.0).rate).norm() < 1e-12 * (1.0 + at(i, 0.0).rate.norm()));
  }
}

TEST_CASE("two knots of a natural spline are a straight line") {
  const std::vector<Column> values{{0.0, 1.0}, {2.0, 5.0}};
  const std::vector<Column> m = spline_curvatures(std::vector<double>{0.5}, values);
  const SplinePoint<Column> middle = spline_point(values[0], values[1], m[0], m[1], 0.5, 0.25);
  CHECK((middle.value - Column(0.5, 2.0)).norm() < 1e-15);
  CHECK((middle.rate - Column(4.0, 8.0)).norm() < 1e-15);
}
