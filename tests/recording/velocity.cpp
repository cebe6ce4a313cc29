// SPDX-License-Identifier: MIT
#include "diabolo/recording/velocity.hpp"

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;

namespace {

/// `position(time)` sampled at 120 Hz as the diabolo's track.
template <class Position>
Recording sampled(Eigen::Index size, const Position& position) {
  Recording recording;
  recording.rate = 120.0;
  recording.time.resize(size);
  recording.frame.assign(static_cast<std::size_t>(size), 0);
  recording.left = recording.right = recording.diabolo = Track::missing(size);
  recording.diabolo.valid.setConstant(true);
  for (Eigen::Index i = 0; i < size; ++i) {
    recording.time[i] = static_cast<double>(i) / 120.0;
    recording.diabolo.position.col(i) = position(recording.time[i]);
  }
  return recording;
}

Velocity diabolo_velocity(const Recording& recording, const VelocityFilter& filter) {
  return velocity(recording, recording.diabolo, filter);
}

}  // namespace

TEST_CASE("The two-point rule is the published one") {
  const Recording recording = sampled(5, [](double t) { return Eigen::Vector3d(t * t, -t, 0.5); });
  const Velocity result = diabolo_velocity(recording, forward_difference());
  CHECK((result.valid == (Marks(5) << true, true, true, true, false).finished()).all());
  for (Eigen::Index i = 0; i < 4; ++i)
    CHECK(((recording.diabolo.position.col(i + 1) - recording.diabolo.position.col(i)) * 120.0 -
           result.velocity.col(i))
              .norm() < 1e-14);
  CHECK(result.velocity.col(4).array().isNaN().all());
}

TEST_CASE("A local polynomial is exact for motions of its degree") {
  for (const FilterWindow window : {FilterWindow::kCausal, FilterWindow::kCentred})
    for (int degree = 1; degree <= 5; ++degree)
      for (const int frames : {degree + 1 + degree % 2, 9, 21}) {
        INFO(degree << " over " << frames);
        const Recording recording = sampled(40, [degree](double t) {
          return Eigen::Vector3d(std::pow(5.0 * t, degree) / 10.0, 1.0 - t, 0.0);
        });
        const Velocity result = diabolo_velocity(recording, local_polynomial(frames, degree, window));
        CHECK(result.valid.count() == 40 - frames + 1);
        for (Eigen::Index i = 0; i < 40; ++i) {
          if (!result.valid[i]) continue;
          const double expected = 0.5 * degree * std::pow(5.0 * recording.time[i], degree - 1);
          CHECK(result.velocity(0, i) == Approx(expected).epsilon(1e-8).margin(1e-8));
          CHECK(result.velocity(1, i) == Approx(-1.0).epsilon(1e-9));
        }
      }
}

TEST_CASE("A causal window uses no frame after its sample") {
  const VelocityFilter filter = local_polynomial(7, 2, FilterWindow::kCausal);
  Recording recording = sampled(30, [](double t) { return Eigen::Vector3d(std::sin(9.0 * t), t, 0.0); });
  const Velocity before = diabolo_velocity(recording, filter);
  recording.diabolo.position.rightCols(10).array() += 1.0;
  const Velocity after = diabolo_velocity(recording, filter);
  CHECK(before.velocity.middleCols(6, 14) == after.velocity.middleCols(6, 14));
  CHECK(before.velocity.col(20) != after.velocity.col(20));
  CHECK(!before.valid.head(6).any());
  CHECK(before.valid.tail(24).all());
}

TEST_CASE("A local polynomial of three centred frames is the central difference") {
  const VelocityFilter polynomial = local_polynomial(3, 2, FilterWindow::kCentred),
                       difference = central_difference();
  CHECK(polynomial.first == difference.first);
  CHECK((polynomial.weight - difference.weight).norm() < 1e-14);
}

TEST_CASE("Stated bandwidths are where sine waves come through at -3 dB") {
  CHECK(forward_difference().bandwidth(120.0) == Approx(0.4429 * 120.0).epsilon(1e-3));
  CHECK(central_difference().bandwidth(120.0) == Approx(0.2215 * 120.0).epsilon(1e-3));
  for (const VelocityFilter& filter :
       {forward_difference(), central_difference(), local_polynomial(7, 2, FilterWindow::kCentred),
        local_polynomial(9, 2, FilterWindow::kCausal), local_polynomial(5, 1, FilterWindow::kCausal)}) {
    const double bandwidth = filter.bandwidth(120.0), omega = 2.0 * std::numbers::pi * bandwidth;
    INFO("bandwidth " << bandwidth << " Hz");
    REQUIRE(bandwidth < 60.0);
    // Sine and cosine together give the amplitude of the estimate at every sample.
    const Recording wave = sampled(
        60, [omega](double t) { return Eigen::Vector3d(std::sin(omega * t), std::cos(omega * t), 0.0); });
    const Velocity result = diabolo_velocity(wave, filter);
    for (Eigen::Index i = 0; i < 60; ++i)
      if (result.valid[i])
        CHECK(result.velocity.col(i).norm() / omega == Approx(1.0 / std::numbers::sqrt2).epsilon(1e-3));
    CHECK(filter.peak_gain() >= 1.0);
  }
}

TEST_CASE("Stated noise gains are what white noise gives") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0.0, 1e-3);
  const Recording noise = sampled(60'000, [&](double) {
    return Eigen::Vector3d(normal(generator), normal(generator), normal(generator));
  });
  for (const VelocityFilter& filter :
       {forward_difference(), central_difference(), local_polynomial(9, 2, FilterWindow::kCentred),
        local_polynomial(9, 2, FilterWindow::kCausal)}) {
    double sum = 0.0;
    Eigen::Index count = 0;
    const Velocity result = diabolo_velocity(noise, filter);
    for (Eigen::Index i = 0; i < noise.size(); ++i)
      if (result.valid[i]) sum += result.velocity.col(i).squaredNorm(), count += 3;
    const double measured = std::sqrt(sum / static_cast<double>(count)) / 1e-3;
    // 180 000 values, neighbours correlated over 9 frames: a standard error below 1 %.
    CHECK(measured == Approx(filter.noise_gain(120.0)).epsilon(0.05));
  }
}

TEST_CASE("Stated delays are those of slow motions") {
  CHECK(forward_difference().delay(120.0) == Approx(-0.5 / 120.0));
  CHECK(central_difference().delay(120.0) == Approx(0.0).margin(1e-15));
  CHECK(local_polynomial(9, 2, FilterWindow::kCausal).delay(120.0) == Approx(0.0).margin(1e-12));
  CHECK(local_polynomial(9, 1, FilterWindow::kCausal).delay(120.0) == Approx(4.0 / 120.0));
  const VelocityFilter late = local_polynomial(9, 1, FilterWindow::kCausal);
  const Recording speeding = sampled(40, [](double t) { return Eigen::Vector3d(0.5 * t * t, 0.0, 0.0); });
  const Velocity result = diabolo_velocity(speeding, late);
  CHECK(result.velocity(0, 20) == Approx(speeding.time[20] - late.delay(120.0)));
}

TEST_CASE("A dropout or gap anywhere in the window leaves no estimate") {
  Recording recording = sampled(40, [](double t) { return Eigen::Vector3d(t, t, t); });
  recording.diabolo.valid[10] = false;
  recording.diabolo.position.col(10).setConstant(kNaN);
  recording.time.tail(15).array() += 2.0 / 120.0;  // a gap between samples 24 and 25
  const Velocity causal = diabolo_velocity(recording, local_polynomial(5, 2, FilterWindow::kCausal));
  const Velocity centred = diabolo_velocity(recording, local_polynomial(5, 2, FilterWindow::kCentred));
  for (Eigen::Index i = 0; i < 40; ++i) {
    INFO("sample " << i);
    CHECK(causal.valid[i] == (i >= 4 && !(i >= 10 && i <= 14) && !(i >= 25 && i <= 28)));
    CHECK(centred.valid[i] == (i >= 2 && i <= 37 && !(i >= 8 && i <= 12) && !(i >= 23 && i <= 26)));
    CHECK(causal.velocity.col(i).array().isNaN().all() == !causal.valid[i]);
  }
}

TEST_CASE("Windows that cannot be fitted are refused") {
  CHECK_THROWS_AS(local_polynomial(2, 2, FilterWindow::kCausal), std::invalid_argument);
  CHECK_THROWS_AS(local_polynomial(5, 0, FilterWindow::kCausal), std::invalid_argument);
  CHECK_THROWS_AS(local_polynomial(100, 9, FilterWindow::kCausal), std::invalid_argument);
  CHECK_THROWS_AS(local_polynomial(4, 2, FilterWindow::kCentred), std::invalid_argument);
  const Recording recording = sampled(5, [](double t) { return Eigen::Vector3d(t, t, t); });
  CHECK_THROWS_AS(velocity(recording, Track::missing(4), central_difference()), RecordingError);
}
