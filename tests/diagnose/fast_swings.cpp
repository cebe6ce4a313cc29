// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/fast_swings.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"

#include "played.hpp"

using namespace diabolo;

namespace {

/// What windows want of a carrier's sine and cosine where sin(2 pi f t + phase) is at work.
std::vector<diagnose_detail::Demodulated> seen(double frequency, double carrier, double phase) {
  std::vector<diagnose_detail::Demodulated> windows;
  for (double t = 0.3; t < 25.0; t += 0.5) {
    const double turned = 2.0 * std::numbers::pi * (frequency - carrier) * t + phase;
    const Eigen::Matrix2d information{{4.0 + std::sin(t), 0.5}, {0.5, 3.0}};
    windows.push_back({t, information, information * Eigen::Vector2d(std::cos(turned), std::sin(turned))});
  }
  return windows;
}

}  // namespace

TEST_CASE("the frequency beside a carrier is found on either side of it") {
  for (const double frequency : {1.05, 1.5, 1.83})
    for (const double phase : {0.0, 1.0, -2.5}) {
      CAPTURE(frequency, phase);
      const auto [found, gain] = diagnose_detail::best_beside(1.5, seen(frequency, 1.5, phase), 25.0);
      CHECK(std::abs(found - frequency) <= 0.25 / 25.0);
      CHECK(gain > 100.0);
    }
}

TEST_CASE("a push to and fro that is faster than windows follow is learnt at its frequency") {
  const Law gust("gust", "a gust", Acts::kLeft, "size * sin(2 * pi * 1.7 * t + 0.4)",
                 {{"size", "m/s^2", 0.3, 0.0, -1e3, 1e3}});
  AllEffects<double> effects;
  effects.get<FormulaLaws>() = FormulaLaws<double>({gust});
  effects.get<FormulaLaws>().numbers[0] = 0.6;
  const Diagnosis d = diagnose({played(effects, 20.0, 41)});
  CAPTURE(d.sentence);
  REQUIRE_FALSE(d.learnt.empty());
  const Learnt& learnt = d.learnt.front();
  CAPTURE(learnt.law.formula.text(), learnt.value);
  CHECK(learnt.law.acts == Acts::kLeft);
  REQUIRE(learnt.value.size() == 3);
  CHECK(learnt.value[1] == Approx(1.7).margin(0.03));
  CHECK(std::abs(learnt.value[0]) == Approx(0.6).margin(0.15));
}
