// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/hidden_noise.hpp"

#include <cmath>
#include <random>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/recording/recording.hpp"

#include "played.hpp"
#include "recording/support.hpp"

using namespace diabolo;

namespace {

/// So many windows of half a second that leave noise averaged over five rows, and `swing` [m] at 2 Hz.
std::vector<WindowSystem> left_over(double rate, double deviation, double swing, std::uint32_t seed,
                                    std::size_t count = 160) {
  std::mt19937_64 generator(seed);
  const Eigen::Index rows = std::lround(0.5 * rate);
  std::vector<WindowSystem> systems(count);
  for (WindowSystem& system : systems) {
    system.residuals.resize(3, rows);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::VectorXd given =
          drawn_noise(rows + 4, std::sqrt(5.0) * deviation, 0.0, generator);  // averaged: a fifth of it
      for (Eigen::Index i = 0; i < rows; ++i)
        system.residuals(axis, i) =
            given.segment(i, 5).mean() + swing * std::sin(4.0 * M_PI * static_cast<double>(i) / rate);
    }
  }
  return systems;
}

TrackNoise hidden(const std::vector<WindowSystem>& systems, double rate, double growth = 2.0) {
  TrackNoise noise;
  noise.deviation.setConstant(5e-5);
  return diagnose_detail::noise_beside_motion(noise, systems.data(), systems.size(), rate, growth);
}

/// All tracks as their mean over five rows.
void average(Recording& r) {
  for (Track* track : {&r.left, &r.right, &r.diabolo}) {
    const Track given = *track;
    for (Eigen::Index i = 2; i + 2 < r.size(); ++i)
      track->position.col(i) = given.position.middleCols(i - 2, 5).rowwise().mean();
  }
}

}  // namespace

TEST_CASE("noise that rows hide is measured by what a fit leaves, with how long it lives") {
  const TrackNoise noise = hidden(left_over(kRate, 3e-4, 0.0, test::fresh_seed()), kRate);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(noise.deviation[axis] == Approx(3e-4).epsilon(0.15));
    CHECK(noise.correlation[axis] > 0.3);
    CHECK(noise.correlation[axis] < 0.8);
  }
}

TEST_CASE("rows that nobody saw take nothing but themselves") {
  std::vector<WindowSystem> systems = left_over(kRate, 3e-4, 0.0, test::fresh_seed());
  for (WindowSystem& system : systems) system.residuals.middleCols(20, 4).setConstant(kNaN);
  CHECK(hidden(systems, kRate).deviation[0] == Approx(3e-4).epsilon(0.15));
}

TEST_CASE("what grows as the displacement by a force does is no noise") {
  for (const double rate : {15.0, 24.0, 25.0, 30.0, 60.0, kRate, 1000.0}) {
    CAPTURE(rate);
    CHECK((hidden(left_over(rate, 1e-6, 0.01, test::fresh_seed()), rate, 20.0).deviation == 5e-5).all());
  }
  CHECK((hidden(left_over(30.0, 1e-6, 0.01, test::fresh_seed(), 4), 30.0).deviation == 5e-5).all());
}

TEST_CASE("nothing is missing in a play whose tracks were smoothed, and what is missing is told") {
  AllEffects<double> effects;
  Recording right = played(effects, 14.0, 1);
  average(right);
  const Diagnosis none = diagnose({right});
  CAPTURE(none.sentence);
  CHECK(none.headline == Headline::kNothingMissing);
  effects.get<UnnamedForce>().string_binormal = 0.8;
  effects.get<UnnamedForce>().speed_exponent = 2.0;
  Recording pushed = played(effects, 14.0, 8);
  average(pushed);
  const Diagnosis some = diagnose({pushed});
  CAPTURE(some.sentence);
  CHECK(some.headline == Headline::kUnnamedStructure);
  REQUIRE(some.learnt.size() == 1);
  CHECK(some.learnt.front().law.acts == Acts::kAcross);
}
