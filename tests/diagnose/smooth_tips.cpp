// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/smooth_tips.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "catch.hpp"

using namespace diabolo;

namespace {

/// A tip whose height at time t is `height(t)`, seen with noise.
template <class Height>
Track seen_tip(const Height& height, double seconds, double rate, double noise, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal(0.0, noise);
  const Eigen::Index rows = static_cast<Eigen::Index>(seconds * rate);
  Track tip = Track::missing(rows);
  tip.valid.setConstant(true);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double z = height(static_cast<double>(i) / rate);
    tip.position.col(i) = Eigen::Vector3d(normal(generator), normal(generator), z + normal(generator));
  }
  return tip;
}

}  // namespace

TEST_CASE("a smoothed tip accelerates with the noise as much as a simulation may see") {
  for (const double rate : {60.0, 120.0, 240.0, 360.0}) {
    CAPTURE(rate);
    const Track tip = smoothed(seen_tip([](double) { return 1.25; }, 60.0, rate, 4e-4, 3), rate);
    const Eigen::Index margin = static_cast<Eigen::Index>(0.2 * rate), count = tip.valid.size() - 2 * margin;
    const Eigen::Matrix3Xd x = tip.position.middleCols(margin, count);
    const Eigen::Matrix3Xd second =
        (x.rightCols(count - 2) - 2.0 * x.middleCols(1, count - 2) + x.leftCols(count - 2)) * (rate * rate);
    const double size = std::sqrt(second.squaredNorm() / static_cast<double>(second.size()));
    CHECK(size < 1.1 * kTipNoiseAcceleration);
    CHECK(size > 0.5 * kTipNoiseAcceleration);
  }
}

TEST_CASE("smoothing loses next to nothing of a hand's motion") {
  constexpr double kRate = 100.0, kNoise = 5e-4;
  for (const double frequency : {1.0, 2.0, 4.0}) {
    const auto height = [frequency](double t) {
      return 0.05 * std::sin(2.0 * std::numbers::pi * frequency * t);
    };
    const Track still = seen_tip(height, 60.0, kRate, 0.0, 4),
                noisy = seen_tip(height, 60.0, kRate, kNoise, 4);
    const Track smooth = smoothed(noisy, kRate);
    const double amplitude =
        smooth.position.row(2).dot(still.position.row(2)) / still.position.row(2).squaredNorm();
    CAPTURE(frequency);
    CHECK(std::abs(amplitude - 1.0) < 5e-3);  // parabolas that are as quiet lose 1.1 % of 4 Hz
  }
}

TEST_CASE("a motion of the fourth order stays as it is, and so do rows that nobody saw") {
  const auto height = [](double t) {
    return 1.2 + 0.3 * t - 0.2 * t * t + 0.1 * t * t * t - 0.04 * t * t * t * t;
  };
  constexpr double kRate = 120.0;
  const Track exact = seen_tip(height, 4.0, kRate, 0.0, 5);
  Track tip = exact;
  std::mt19937_64 generator(6);
  std::normal_distribution<double> normal(0.0, 4e-4);
  for (Eigen::Index i = 0; i < tip.valid.size(); ++i)
    for (int k = 0; k < 2; ++k) tip.position(k, i) += normal(generator);  // the height stays exact
  tip.valid.segment(200, 9).setConstant(false);
  const Track smooth = smoothed(tip, kRate);
  CHECK((smooth.valid == tip.valid).all());
  CHECK(smooth.position.row(0).squaredNorm() < 0.5 * tip.position.row(0).squaredNorm());
  CHECK((smooth.position.row(2) - exact.position.row(2)).cwiseAbs().maxCoeff() < 1e-9);
}
