// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/open_law.hpp"

#include <random>

#include "catch.hpp"

using namespace diabolo;

namespace {

/// Windows at x from 1 to 6 that say value * (x / 2)^exponent with noise of standard deviation `noisy`.
std::vector<WindowSays> saying(double value, double exponent, std::size_t count, unsigned seed,
                               double noisy = 0.02) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> noise(0.0, noisy);
  std::vector<WindowSays> windows;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = 1.0 + 5.0 * static_cast<double>(i) / static_cast<double>(count - 1);
    windows.push_back({x, value * std::pow(x / 2.0, exponent) + noise(generator), 1.0});
  }
  return windows;
}

}  // namespace

TEST_CASE("the power that a force grows with is found, with its deviation") {
  int within = 0, laws = 0;
  for (const double exponent : {0.0, 0.5, 1.0, 2.0, 3.0})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      CAPTURE(exponent, seed);
      const PowerLaw law = power_law(saying(0.3, exponent, 40, seed, 0.1), "speed", "m/s");
      CHECK(std::abs(law.exponent - exponent) < 4.0 * law.deviation + 0.05);
      CHECK(law.deviation < 0.3);
      CHECK(law.value == Approx(0.3 * std::pow(law.at / 2.0, exponent)).epsilon(0.3));
      CHECK(law.explained > 0.7);
      within += std::abs(law.exponent - exponent) <= law.deviation + 0.025;  // half a step of the grid
      ++laws;
    }
  CHECK(within > laws / 2);  // two in three are meant
  CHECK(within < 0.85 * laws);
}

TEST_CASE("the curve of a law follows what the windows say") {
  const PowerLaw law = power_law(saying(-0.4, 2.0, 60, 7), "speed", "m/s");
  REQUIRE(law.curve.size() == 6);
  for (const auto& [x, y] : law.curve) CHECK(y == Approx(-0.1 * x * x).margin(0.1));
  CHECK(law.value < 0.0);
}

TEST_CASE("what does not grow is constant, and few windows have no law") {
  const PowerLaw law = power_law(saying(0.5, 0.0, 40, 3), "spin", "rad/s");
  CHECK(std::abs(law.exponent) <= 0.05);
  CHECK(power_law(saying(0.5, 1.0, 7, 3), "speed", "m/s").curve.empty());
}

TEST_CASE("a power that the windows do not tell is none") {
  std::vector<WindowSays> windows = saying(0.3, 2.0, 40, 5, 0.01);
  for (WindowSays& window : windows) window.x = 1.0 + 1e-3 * window.x;  // always the same speed
  const PowerLaw law = power_law(windows, "speed", "m/s");
  CHECK(law.exponent == 0.0);
  CHECK(law.deviation > kVagueExponent);
  CHECK(law.deviation <= 4.0);
  CHECK(law.value > 0.3);
}
