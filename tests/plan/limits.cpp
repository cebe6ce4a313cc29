// SPDX-License-Identifier: MIT
#include "diabolo/plan/limits.hpp"

#include <map>

#include "catch.hpp"
#include "plan/splines.hpp"

using namespace diabolo;

namespace {

std::map<std::string, LimitUse> by_name(const TipPath<double>& path, const TipLimits& limits) {
  std::map<std::string, LimitUse> uses;
  for (const LimitUse& use : limit_uses(path, limits, kLength)) uses.emplace(use.name, use);
  return uses;
}

}  // namespace

TEST_CASE("the maximum of a polynomial lies above all its values, by no more than the tolerance") {
  Random random(8200);
  for (int i = 0; i < 200; ++i) {
    std::array<double, 7> c;
    for (double& x : c) x = random.uniform(-5.0, 5.0);
    const PolynomialMaximum most = maximum_on_unit_interval(c, 1e-9);
    const auto value = [&](double s) {
      double sum = 0.0;
      for (std::size_t k = c.size(); k-- > 0;) sum = sum * s + c[k];
      return sum;
    };
    double seen = value(0.0);
    for (int k = 1; k <= 4000; ++k) seen = std::max(seen, value(k / 4000.0));
    CHECK(most.value >= seen - 1e-12);
    CHECK(most.value - seen < 1e-4);
    CHECK(value(most.at) >= most.value - 2e-9);
  }
  CHECK(maximum_on_unit_interval(std::array<double, 3>{2.0, 0.0, 0.0}, 1e-9).value == 2.0);
}

TEST_CASE("numbers too large for a maximum end its search, above all values") {
  CHECK(maximum_on_unit_interval(std::array<double, 3>{1.0, NAN, 0.0}, 1e-9).value == INFINITY);
  CHECK(maximum_on_unit_interval(std::array<double, 3>{1.7e308, 1.7e308, 0.0}, 1e-9).value == INFINITY);
  // Flat, but for rounding far above the tolerance: no reason to look at every last bit of the interval.
  const PolynomialMaximum flat =
      maximum_on_unit_interval(std::array<double, 5>{1e20, -3e4, 4e4, 2e4, -3e4}, 1e-10);
  CHECK(flat.value >= 1e20);
  CHECK(flat.value <= 1.000001e20);
}

TEST_CASE("limits from elsewhere must be numbers") {
  Random random(8205);
  const TipPath<double> path = path_of(random_spline(random, SplineEnds::kClamped));
  TipLimits limits;
  limits.others = [](const TipPath<double>&) {
    return std::vector<LimitUse>{{"elbow", NAN, 1.0, "rad", 0.0, -0.5}};
  };
  CHECK_THROWS_WITH(limit_uses(path, limits, kLength), "limits, elbow: its value is not a number");
  limits.string_margin = INFINITY;
  CHECK_THROWS_WITH(limits.validate(), "limits, string_margin: inf m; must be finite and not negative");
}

TEST_CASE("what a path uses of its limits is the maximum over dense samples") {
  Random random(8201);
  const TipLimits limits;
  for (int i = 0; i < 30; ++i) {
    const TipPath<double> path = path_of(random_spline(random, SplineEnds::kClamped));
    const auto uses = by_name(path, limits);
    double speed = 0.0, acceleration = 0.0, jerk = 0.0, distance = 0.0, gap = 10.0, highest = -10.0;
    for (int k = 0; k <= 20000; ++k) {
      const auto d = path.derivatives_at(path.begin() + (path.end() - path.begin()) * k / 20000.0);
      speed = std::max(speed, d[1].head<3>().norm());
      acceleration = std::max(acceleration, d[2].head<3>().norm());
      jerk = std::max(jerk, d[3].head<3>().norm());
      distance = std::max(distance, (d[0].head<3>() - d[0].tail<3>()).norm());
      gap = std::min(gap, d[0][1] - d[0][4]);
      highest = std::max(highest, d[0][5]);
    }
    const auto agrees = [&](const char* name, double seen, double tolerance) {
      INFO(name);
      CHECK(uses.at(name).value == Approx(seen).margin(tolerance));
    };
    agrees("left tip speed", speed, 1e-5);
    agrees("left tip acceleration", acceleration, 0.1);
    agrees("left tip jerk", jerk, 1e-9);
    agrees("tip distance", distance, 1e-6);
    agrees("gap of the tips", gap, 1e-6);
    agrees("right tip z, highest", highest, 1e-6);
    CHECK(uses.at("left tip speed").value >= speed - 1e-9);
    CHECK(uses.at("tip distance").value >= distance - 1e-9);
    const auto there = path.derivatives_at(uses.at("left tip speed").time);
    CHECK(there[1].head<3>().norm() == Approx(speed).margin(1e-5));
  }
}

TEST_CASE("a path keeps its limits up to the limit itself") {
  Random random(8202);
  const TipPath<double> path = path_of(random_spline(random, SplineEnds::kClamped));
  TipLimits limits;
  limits.acceleration = 1e4;
  limits.speed = 100.0;
  CHECK(keeps(path, limits, kLength));
  const auto uses = by_name(path, limits);
  limits.speed = std::max(uses.at("left tip speed").value, uses.at("right tip speed").value) * 1.001;
  CHECK(keeps(path, limits, kLength));
  limits.speed *= 0.998;
  CHECK_FALSE(keeps(path, limits, kLength));
  CHECK(worst(limit_uses(path, limits, kLength)).name.ends_with("tip speed"));
  limits.speed = 100.0;
  CHECK_FALSE(keeps(path, limits, uses.at("tip distance").value));
  limits.lowest.z() = uses.at("left tip z, lowest").value + 0.001;
  CHECK(worst(limit_uses(path, limits, kLength)).name.ends_with("z, lowest"));
}

TEST_CASE("limits from elsewhere count as the own ones do") {
  Random random(8203);
  const TipPath<double> path = path_of(random_spline(random, SplineEnds::kClamped));
  TipLimits limits;
  limits.acceleration = limits.speed = 1e4;
  REQUIRE(keeps(path, limits, kLength));
  limits.others = [](const TipPath<double>& p) {
    return std::vector<LimitUse>{{"elbow", p.end() - p.begin(), 0.5, "s", 0.0, p.end() - p.begin() - 0.5}};
  };
  CHECK_FALSE(keeps(path, limits, kLength));
  CHECK(worst(limit_uses(path, limits, kLength)).name == "elbow");
}
