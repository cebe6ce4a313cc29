// SPDX-License-Identifier: MIT
#include "diabolo/recording/resample.hpp"

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

namespace {

/// A recording at 100 Hz without dropouts: straight lines and constant turning about a skew axis.
Recording uniform_motion(Eigen::Index size) {
  Recording recording;
  recording.name = "uniform";
  recording.rate = 100.0;
  recording.time.resize(size);
  recording.left = recording.right = recording.diabolo = Track::missing(size);
  recording.diabolo_orientation = recording.left_orientation = OrientationTrack::missing(size);
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 0.2, -0.3).normalized();
  for (Eigen::Index i = 0; i < size; ++i) {
    const double time = static_cast<double>(i) / 100.0;
    recording.time[i] = time;
    recording.frame.push_back(1000 + i);
    recording.left.position.col(i) << 1.0 - time, 2.0 * time, 0.5;
    recording.right.position.col(i) << -time, 0.0, time;
    recording.diabolo.position.col(i) << 0.1, time, 1.0 - time;
    recording.diabolo_orientation.quaternion.col(i) =
        Eigen::Quaterniond(Eigen::AngleAxisd(150.0 * time, axis)).coeffs();
    recording.left_orientation.quaternion.col(i) =
        Eigen::Quaterniond(Eigen::AngleAxisd(2.0 * time, axis)).coeffs();
  }
  for (Marks* mask : {&recording.left.valid, &recording.right.valid, &recording.diabolo.valid,
                      &recording.diabolo_orientation.valid, &recording.left_orientation.valid})
    mask->setConstant(true);
  return recording;
}

}  // namespace

TEST_CASE("At its own times a recording stays as it is, bit for bit, dropouts and all") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  for (std::uint32_t k = 0; k < 50; ++k) {
    const Recording recording = test::random_recording(seed + k);
    Recording result = resample(recording, recording.time);
    result.rate = recording.rate;
    CHECK(test::same(result, recording));
  }
}

TEST_CASE("Times rounded to the microsecond are the same instants") {
  Recording recording = uniform_motion(50);
  recording.rate = 120.0;
  recording.diabolo.valid[20] = false;
  recording.diabolo.position.col(20).setConstant(kNaN);
  for (Eigen::Index i = 0; i < recording.size(); ++i)
    recording.time[i] = 151.191667 + std::round(static_cast<double>(i) / 120.0 * 1e6) / 1e6;
  const Recording result = resample(recording, 120.0);
  REQUIRE(result.size() == recording.size());
  CHECK(result.rate == 120.0);
  CHECK(result.frame == recording.frame);
  CHECK(test::same(result.diabolo, recording.diabolo));
  CHECK(test::same(result.diabolo_orientation, recording.diabolo_orientation));
}

TEST_CASE("Straight lines and constant turning are met between the samples") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  std::mt19937 generator(seed);
  const Recording recording = uniform_motion(50), dense = resample(recording, 733.0);
  CHECK(dense.rate == 733.0);
  CHECK(dense.size() == 1 + static_cast<Eigen::Index>(0.49 * 733.0));
  CHECK(dense.left.valid.all());
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 0.2, -0.3).normalized();
  for (Eigen::Index k = 0; k < dense.size(); ++k) {
    const double time = dense.time[k];
    CHECK((dense.left.position.col(k) - Eigen::Vector3d(1.0 - time, 2.0 * time, 0.5)).norm() < 1e-14);
    const Eigen::Quaterniond expected(Eigen::AngleAxisd(150.0 * time, axis));
    CHECK(std::abs(expected.coeffs().dot(dense.diabolo_orientation.quaternion.col(k))) ==
          Approx(1.0).epsilon(1e-12));
    CHECK(dense.diabolo_orientation.quaternion.col(k).norm() == Approx(1.0).epsilon(1e-15));
  }
}

TEST_CASE("Dropouts and gaps are never bridged, nothing is extrapolated") {
  Recording recording = uniform_motion(10);
  recording.left.valid[4] = false;
  recording.left.position.col(4).setConstant(kNaN);
  recording.time.tail(2).array() += 0.03;  // a gap between samples 7 and 8
  Eigen::VectorXd times(9);
  times << -0.005, 0.0, 0.025, 0.035, 0.04, 0.045, 0.055, 0.085, 0.125;
  const Recording result = resample(recording, times);
  CHECK((result.left.valid ==
         (Marks(9) << false, true, true, false, false, false, true, false, false).finished())
            .all());
  CHECK(
      (result.right.valid == (Marks(9) << false, true, true, true, true, true, true, false, false).finished())
          .all());
  for (Eigen::Index k = 0; k < times.size(); ++k)
    CHECK(result.left.position.col(k).array().isNaN().all() == !result.left.valid[k]);
  CHECK(result.right_orientation.empty());
}

TEST_CASE("Half the rate keeps every other sample, and half of that commutes") {
  const Recording recording = uniform_motion(41);
  const Recording half = resample(recording, 50.0), quarter = resample(recording, 25.0);
  REQUIRE(half.size() == 21);
  for (Eigen::Index k = 0; k < half.size(); ++k)
    CHECK(half.diabolo.position.col(k) == recording.diabolo.position.col(2 * k));
  CHECK(test::same(resample(half, 25.0), quarter));
}

TEST_CASE("Whatever times are asked for, the result keeps a recording's promises") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  std::mt19937 generator(seed);
  for (std::uint32_t k = 0; k < 50; ++k) {
    const Recording recording = test::random_recording(seed + k);
    std::exponential_distribution<double> step(
        std::uniform_real_distribution<double>(20.0, 500.0)(generator));
    Eigen::VectorXd times(30);
    times[0] = recording.time[0] - 0.1;
    for (Eigen::Index i = 1; i < times.size(); ++i) times[i] = times[i - 1] + 1e-5 + step(generator);
    CHECK_NOTHROW(check_recording(resample(recording, times)));
  }
}

TEST_CASE("Times that do not increase are refused") {
  const Recording recording = uniform_motion(5);
  CHECK(complaint([&] { resample(recording, Eigen::Vector2d(0.01, 0.01)); }) ==
        "resampling of recording \"uniform\": time 0.01 s at index 1; expected increasing times");
  CHECK(complaint([&] { resample(recording, Eigen::Vector2d(kNaN, 0.01)); }) ==
        "resampling of recording \"uniform\": time nan s at index 0; expected increasing times");
  CHECK(complaint([&] { resample(recording, -1.0); }) ==
        "resampling of recording \"uniform\": rate -1 Hz; expected more than 0, at most 1e6");
  Recording empty;
  empty.rate = 120.0;
  CHECK(complaint([&] { resample(empty, 60.0); }) ==
        "resampling of recording \"\": the recording has no samples");
}
