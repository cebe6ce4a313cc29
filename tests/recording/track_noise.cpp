// SPDX-License-Identifier: MIT
#include "diabolo/recording/track_noise.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;

namespace {

constexpr double kRate = 120.0;

/// Swung by 0.3 m at 1.5 Hz, with three kicks of 3 m/s.
Track swung(Eigen::Index size) {
  Track track{Eigen::Matrix3Xd::Zero(3, size), Marks::Constant(size, true)};
  for (Eigen::Index i = 0; i < size; ++i) {
    const double t = static_cast<double>(i) / kRate;
    track.position.col(i) << 0.3 * std::sin(3.0 * M_PI * t), 0.2 * std::cos(2.0 * M_PI * t),
        3.0 * std::abs(t - std::round(t / 4.0) * 4.0);
  }
  return track;
}

void shake(Track& track, double deviation, double correlation, std::uint32_t seed) {
  std::mt19937_64 generator(seed);
  for (int axis = 0; axis < 3; ++axis)
    track.position.row(axis) += drawn_noise(track.valid.size(), deviation, correlation, generator);
}

}  // namespace

TEST_CASE("noise is measured beside motion and kicks, whatever its size") {
  const std::uint32_t seed = test::fresh_seed();
  for (const double deviation : {1e-4, 3e-4, 1e-3, 5e-3}) {
    Track track = swung(3000);
    shake(track, deviation, 0.0, seed);
    const TrackNoise noise = track_noise(track);
    CAPTURE(deviation);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(noise.deviation[axis] == Approx(deviation).epsilon(0.25));
      CHECK(noise.correlation[axis] < 0.35);
    }
  }
}

TEST_CASE("motion without noise has next to none") {
  const TrackNoise noise = track_noise(swung(3000));
  CHECK((noise.deviation < 2e-5).all());
}

TEST_CASE("what lives on from frame to frame is told from what does not") {
  std::mt19937 seeds(test::fresh_seed());
  Eigen::Array3d deviation = Eigen::Array3d::Zero(), correlation = deviation;
  for (int i = 0; i < 10; ++i) {
    Track track = swung(6000);
    shake(track, 1e-3, 0.3, static_cast<std::uint32_t>(seeds()));
    deviation += 0.1 * track_noise(track).deviation;
    correlation += 0.1 * track_noise(track).correlation;
  }
  CHECK(correlation.mean() == Approx(0.3).margin(0.08));  // one track of 50 s: give or take 0.09 each
  CHECK(deviation.mean() == Approx(1e-3).epsilon(0.1));
}

TEST_CASE("a track that was smoothed or interpolated hides its noise, one that was not does not") {
  const std::uint32_t seed = test::fresh_seed();
  for (const double correlation : {0.0, 0.5, 0.9}) {
    constexpr Eigen::Index kRows = 12000;  // of 300 seeds none comes nearer than 0.07 to the bound
    Track track = swung(kRows);
    shake(track, 1e-3, correlation, seed);
    CAPTURE(correlation);
    CHECK(growth_of_differences(track, kRate) < kHidden);
    if (correlation > 0.5) continue;  // little of it is in neighbouring rows as it is
    Track averaged = track, straight = track;
    for (Eigen::Index i = 2; i + 2 < kRows; ++i)
      averaged.position.col(i) = track.position.middleCols(i - 2, 5).rowwise().mean();
    for (Eigen::Index i = 1; i + 1 < kRows; i += 2)
      straight.position.col(i) = 0.5 * (track.position.col(i - 1) + track.position.col(i + 1));
    CHECK(growth_of_differences(averaged, kRate) > kHidden);
    CHECK(growth_of_differences(straight, kRate) > kHidden);
    CHECK(growth_of_differences(straight, 30.0) == 1.0);  // too slow to tell
  }
}

TEST_CASE("dropouts take nothing but their own rows") {
  const std::uint32_t seed = test::fresh_seed();
  Track track = swung(3000);
  shake(track, 3e-4, 0.0, seed);
  for (Eigen::Index i = 0; i < 3000; ++i)
    if (i % 50 < 7) track.valid[i] = false, track.position.col(i).setConstant(kNaN);
  CHECK(track_noise(track).deviation[0] == Approx(3e-4).epsilon(0.25));
  track.valid.setConstant(false);
  CHECK((track_noise(track).deviation == 0.0).all());
}

TEST_CASE("the noise of an angle is found in the spin that its changes make") {
  const std::uint32_t seed = test::fresh_seed();
  std::mt19937_64 generator(seed);
  const Eigen::VectorXd angle = drawn_noise(3001, 3e-3, 0.0, generator);
  Eigen::VectorXd spin(3000);
  for (Eigen::Index i = 0; i < 3000; ++i)
    spin[i] = 60.0 + 5.0 * std::sin(static_cast<double>(i) / kRate) + kRate * (angle[i + 1] - angle[i]);
  CHECK(angle_noise(spin, Marks::Constant(3000, true), kRate) == Approx(3e-3).epsilon(0.15));
}
