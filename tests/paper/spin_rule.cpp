// SPDX-License-Identifier: MIT
#include "diabolo/paper/spin_rule.hpp"

#include "catch.hpp"

using namespace diabolo;

namespace {

Parameters<double> with_coupling(double rate) {
  Parameters<double> parameters;
  parameters.spin_coupling = rate;
  return parameters;
}

}  // namespace

TEST_CASE("the paper's spin grows by mu per metre, whatever the spin") {
  Parameters<double> parameters;
  parameters.pull.mu_acceleration = 100.0;
  parameters.pull.mu_deceleration = 30.0;
  for (const double spin : {-200.0, 0.0, 200.0, 1e4}) {
    CHECK(spin_after_length_change(spin, 0.01, parameters) == Approx(spin + 1.0));
    CHECK(spin_after_length_change(spin, -0.01, parameters) == Approx(spin - 0.3));
    CHECK(spin_after_length_change(spin, 0.0, parameters) == spin);
  }
}

TEST_CASE("slip is worn off at the given rate and never overshot, however long the step") {
  const double speed = 2.0;
  for (const double rate : {0.0, 1e-3, 0.15, 1.0, 100.0, 1e3})
    for (const double dt : {1e-4, 1e-3, 1e-2, 0.1, 10.0})
      for (const double spin : {-500.0, 0.0, 700.0}) {
        const Parameters<double> parameters = with_coupling(rate);
        const double target = speed / parameters.axle_radius;
        const double share = (spin_after_slip(spin, speed, dt, parameters) - spin) / (target - spin);
        CAPTURE(rate, dt, spin, share);
        CHECK(share >= 0.0);
        CHECK(share <= 1.0);
        // exp(-z) to second order: the remainder is z^3 / 6 at most.
        const double z = rate * dt, exact = 1.0 - std::exp(-z);
        CHECK(share == Approx(exact).epsilon(0).margin(z * z * z / 6.0 + 1e-12));
      }
}

TEST_CASE("without slip the spin stays") {
  const Parameters<double> parameters = with_coupling(3.0);
  const double spin = 120.0, speed = spin * parameters.axle_radius;
  CHECK(spin_after_slip(spin, speed, 0.01, parameters) == Approx(spin).epsilon(1e-15));
  CHECK(spin_after_slip_explicit(spin, speed, 0.01, parameters) == Approx(spin).epsilon(1e-15));
}

TEST_CASE("the spin follows the slip with second order in the step, the published rule with first") {
  const Parameters<double> parameters = with_coupling(5.0);
  const double exact = 300.0 * std::exp(-5.0 * 0.4);
  const auto error = [&](auto&& rule, int steps) {
    double spin = 300.0;
    for (int i = 0; i < steps; ++i) spin = rule(spin, 0.0, 0.4 / steps, parameters);
    return std::abs(spin - exact);
  };
  const auto implicit = [](double w, double u, double t, const Parameters<double>& p) {
    return spin_after_slip(w, u, t, p);
  };
  const auto explicit_rule = [](double w, double u, double t, const Parameters<double>& p) {
    return spin_after_slip_explicit(w, u, t, p);
  };
  CHECK(error(implicit, 100) / error(implicit, 200) == Approx(4.0).epsilon(0.05));
  CHECK(error(explicit_rule, 100) / error(explicit_rule, 200) == Approx(2.0).epsilon(0.05));
}

TEST_CASE("the published rule in the published numbers: 0.00015 / r of the slip in each step") {
  Parameters<double> parameters = Parameters<double>::published();
  const double spin = 80.0, speed = 1.7, r = parameters.axle_radius;
  const double expected = spin + (speed - spin * r) * 0.00015 / r;
  CHECK(spin_after_slip_explicit(spin, speed, parameters.pull.reference_step, parameters) ==
        Approx(expected).epsilon(1e-14));
}
