// SPDX-License-Identifier: MIT
#include "diabolo/recording/formats/spin_line.hpp"

#include <numbers>

#include "catch.hpp"
#include "diabolo/recording/formats/calibration.hpp"
#include "diabolo/recording/formats/motive.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

namespace {

/// A body that spins about a line (unit axis through a point of its frame) that swings and yaws.
TrackedTake spinning(const Eigen::Vector3d& axis, const Eigen::Vector3d& point, double spin, double noise,
                     std::uint32_t seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0.0, noise);
  const Eigen::Index size = 600;
  TrackedTake take;
  take.file_name = "take.csv";
  take.rate = 120.0;
  take.time.resize(size);
  take.bodies.push_back(
      {"diabolo", Eigen::Matrix4Xd(4, size), Eigen::Matrix3Xd(3, size), Marks::Constant(size, true)});
  TrackedBody& body = take.bodies[0];
  for (Eigen::Index i = 0; i < size; ++i) {
    const double time = static_cast<double>(i) / 120.0;
    take.frame.push_back(i);
    take.time[i] = time;
    const Eigen::Quaterniond rotation =
        Eigen::AngleAxisd(0.2 * std::sin(2.0 * time), Eigen::Vector3d::UnitZ()) *
        Eigen::Quaterniond(Eigen::AngleAxisd(spin * time, axis));
    const Eigen::Vector3d centre(0.3 * std::sin(4.0 * time), 0.1 * time, 0.5 + 0.2 * std::cos(3.0 * time));
    body.quaternion.col(i) = rotation.coeffs();
    body.position.col(i) =
        centre - rotation * point + Eigen::Vector3d(normal(generator), normal(generator), normal(generator));
  }
  return take;
}

}  // namespace

TEST_CASE("A spin line is found again, also under noise and between dropouts") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  const Eigen::Vector3d axis = Eigen::Vector3d(0.99, -0.05, 0.1).normalized();
  const Eigen::Vector3d point =
      Eigen::Vector3d(0.0, 0.02, 0.01) - Eigen::Vector3d(0.0, 0.02, 0.01).dot(axis) * axis;
  TrackedTake take = spinning(axis, point, 100.0, 0.0, seed);
  SpinLine line = find_spin_line(take, take.bodies[0]);
  CHECK((line.axis - axis).norm() < 2e-3);
  CHECK((line.point - point).norm() < 1e-4);
  CHECK(line.samples == 598);

  take = spinning(axis, point, 100.0, 5e-4, seed);
  take.bodies[0].valid[300] = false;
  take.bodies[0].position.col(301) << 9.0, 9.0, 9.0;  // beside a dropout poses are not believed
  line = find_spin_line(take, take.bodies[0]);
  CHECK((line.axis - axis).norm() < 2e-3);
  CHECK((line.point - point).norm() < 1e-3);
  CHECK(line.samples == 598 - 7);
}

TEST_CASE("A body that rests shows no spin line") {
  const TrackedTake take = spinning(Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero(), 0.0, 1e-4, 1);
  CHECK(complaint([&] { find_spin_line(take, take.bodies[0]); }) ==
        "take.csv: \"diabolo\" does not spin enough to show its axis");
  TrackedTake missing = spinning(Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero(), 100.0, 0.0, 1);
  missing.bodies[0].valid.setConstant(false);
  CHECK(complaint([&] { find_spin_line(missing, missing.bodies[0]); }).ends_with("to show its axis"));
}

TEST_CASE(
    "In the published takes the red diabolo's line is the published one within 2 mm and half a degree") {
  const auto folder = test::recordings_folder("the red diabolo's spin line in the published takes");
  if (!folder) return;
  const BodyPoint red = published_calibration().diabolo;
  const Eigen::Vector3d point = red.point - red.point.dot(red.axis) * red.axis;
  for (const char* name :
       {"y_swing_2", "z_hop_1", "z_hop_2", "acceleration_1", "right_hand_extend_1", "throw_1"}) {
    INFO(name);
    const TrackedTake take = load_motive(*folder / "2020-07-11_basic_physics" / (std::string(name) + ".csv"));
    const SpinLine line = find_spin_line(take, *body_of_name(take, red.bodies));
    CHECK((line.point - point).norm() < 2e-3);
    CHECK((line.axis + red.axis).norm() < 0.5 * std::numbers::pi / 180.0);
  }
}
