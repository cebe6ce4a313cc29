// SPDX-License-Identifier: MIT
#include "diabolo/recording/check.hpp"

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

TEST_CASE("Quaternions within a thousandth of unit norm are normalised, others refused") {
  Eigen::Vector4d quaternion(0.0, 0.6, 0.0, 0.8009);
  CHECK(normalize_quaternion(quaternion));
  CHECK(quaternion.norm() == Approx(1.0).epsilon(1e-15));
  for (const double factor : {0.0, 0.998, 1.002, -0.5, 1e300, kNaN}) {
    Eigen::Vector4d wrong = factor * Eigen::Vector4d(0.0, 0.6, 0.0, 0.8);
    CHECK(!normalize_quaternion(wrong));
  }
}

TEST_CASE("Normalising twice is normalising once, bit for bit") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> factor(0.9995, 1.0005);
  for (int i = 0; i < 10'000; ++i) {
    Eigen::Vector4d once(normal(generator), normal(generator), normal(generator), normal(generator));
    once *= factor(generator) / once.norm();
    REQUIRE(normalize_quaternion(once));
    Eigen::Vector4d twice = once;
    REQUIRE(normalize_quaternion(twice));
    CHECK(twice == once);
  }
}

TEST_CASE("A rate that the times contradict is refused") {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(7, 0.0, 0.1);
  CHECK_NOTHROW(check_rate(60.0, time, "f"));
  CHECK_NOTHROW(check_rate(60.0, {}, "f"));
  CHECK(complaint([&] {
          check_rate(120.0, time, "f");
        }).starts_with("f: rate 120 Hz, but the times step by 0.01"));
  for (const double rate : {0.0, -1.0, 1e7, kNaN, std::numeric_limits<double>::infinity()})
    CHECK(complaint([&] { check_rate(rate, time, "f"); }) != "(no complaint)");
}

TEST_CASE("A row of a file that comes a microsecond after another is refused") {
  Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(121, 0.0, 1.0);
  time[60] = time[59] + 1e-6;
  CHECK(complaint([&] { check_rows_apart(time, "f"); }) ==
        "f: the row at 0.492 s comes 1 us after the one before; expected one row an instant");
  time[60] = time[59] + 1e-4;
  CHECK_NOTHROW(check_rows_apart(time, "f"));
}

TEST_CASE("Several rows an instant are refused, with or without a rate that would fit") {
  Eigen::VectorXd time(120);
  for (Eigen::Index i = 0; i < 120; ++i)
    time[i] = static_cast<double>(i / 2) / 120.0 + 1e-6 * static_cast<double>(i % 2);
  for (const double rate : {120.0, 1e6, 240.0})
    CHECK(complaint([&] { check_rate(rate, time, "f"); }) ==
          "f: 60 of 120 rows come within 0.083 ms of the row before, as if an instant had several; expected "
          "one row an instant");
  for (Eigen::Index i = 0; i < 120; ++i) time[i] = static_cast<double>(i) / 120.0 + (i > 60 ? 900.0 : 0.0);
  CHECK_NOTHROW(check_rate(120.0, time, "f"));  // one long gap
}

TEST_CASE("Rates in sentences are rounded") {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(7, 0.0, 0.1);
  CHECK(complaint([&] { check_rate(119.99999881, time, "f"); }) ==
        "f: rate 120 Hz, but the times step by 0.016667 s (60 Hz)");
}

TEST_CASE("An axle as thick as the cups is refused") {
  DiaboloProperties thick = kRedDiabolo;
  thick.axle_radius = 0.065;
  CHECK(complaint([&] { check_properties(thick, 1.46, "f"); }) ==
        "f: diabolo.axle_radius [m] 0.065: an axle as thick as the cups; expected less than half of "
        "diabolo.diameter [m], 0.0635");
  thick.axle_radius = 0.06;
  CHECK_NOTHROW(check_properties(thick, 1.46, "f"));
}

TEST_CASE("Random recordings pass the check, and each broken promise is named") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  for (std::uint32_t k = 0; k < 50; ++k) CHECK_NOTHROW(check_recording(test::random_recording(seed + k)));

  Recording good = test::random_recording(seed);
  for (std::uint32_t k = 1; good.size() < 3; ++k) good = test::random_recording(seed + k);
  good.left = Track::missing(good.size());
  const auto says = [&good](const auto& breaking) {
    Recording broken = good;
    breaking(broken);
    return complaint([&] { check_recording(broken); });
  };
  CHECK(says([](Recording& r) { r.frame.pop_back(); }).find("frame numbers") != std::string::npos);
  CHECK(says([](Recording& r) { r.time[1] = r.time[0]; }).find("sample 1: time") != std::string::npos);
  CHECK(says([](Recording& r) { r.time[0] = kNaN; }).find("sample 0: time nan") != std::string::npos);
  CHECK(says([](Recording& r) { r.rate = 60.0; }).find("rate 60 Hz") != std::string::npos);
  CHECK(says([](Recording& r) { r.properties.mass = 0.0; }).find("mass [kg] 0;") != std::string::npos);
  CHECK(says([](Recording& r) { r.string_length = kNaN; }).find("string_length [m] nan;") !=
        std::string::npos);
  CHECK(says([](Recording& r) {
          r.assumed = {"mass"};
        }).ends_with(": assumed: \"mass\"; expected \"string_length\" or \"diabolo\", each once"));
  CHECK(says([](Recording& r) {
          r.assumed = {"diabolo", "diabolo"};
        }).find("assumed: \"diabolo\" is there twice; expected") != std::string::npos);
  CHECK(says([](Recording& r) { r.left.valid[0] = true; }).find("left tip, sample 0") != std::string::npos);
  CHECK(says([](Recording& r) { r.left.position(1, 0) = 0.0; }).find("NaN in a dropout") !=
        std::string::npos);
  CHECK(says([](Recording& r) { r.right = Track::missing(1); }).find("right tip: 1 positions") !=
        std::string::npos);
  CHECK(says([](Recording& r) {
          r.diabolo.valid[0] = true;
          r.diabolo.position.col(0) << 0.0, 101.0, 0.0;
        }).find("numbers within 100 m") != std::string::npos);
  CHECK(says([](Recording& r) {
          r.diabolo_orientation.valid[0] = true;
          r.diabolo_orientation.quaternion.col(0) << 0.0, 0.0, 0.0, 1.1;
        }).find("diabolo orientation, sample 0: quaternion of norm 1.1") != std::string::npos);
}
