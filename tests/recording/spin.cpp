// SPDX-License-Identifier: MIT
#include "diabolo/recording/spin.hpp"

#include "catch.hpp"
#include "recording/support.hpp"

using namespace diabolo;

namespace {

/// A diabolo whose axle points along world x (or against it), turned by `yaw` about z, spinning at `spin`
/// [rad/s] about that direction.
Recording spinning(double spin, bool backwards = false, double yaw = 0.0) {
  const Eigen::Index size = 30;
  Recording recording;
  recording.rate = 120.0;
  recording.time = Eigen::VectorXd::LinSpaced(size, 0.0, static_cast<double>(size - 1) / 120.0);
  recording.frame.assign(static_cast<std::size_t>(size), 0);
  recording.left = recording.right = recording.diabolo = Track::missing(size);
  recording.diabolo_orientation = OrientationTrack::missing(size);
  recording.diabolo_orientation.valid.setConstant(true);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::Quaterniond orientation =
        Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
        Eigen::AngleAxisd(spin * recording.time[i], Eigen::Vector3d::UnitX()) *
        Eigen::Quaterniond(Eigen::AngleAxisd(backwards ? std::numbers::pi : 0.0, Eigen::Vector3d::UnitY()));
    recording.diabolo_orientation.quaternion.col(i) = orientation.coeffs() * (i % 3 == 0 ? -1.0 : 1.0);
  }
  return recording;
}

}  // namespace

TEST_CASE("Spin about world -x is positive, whichever way body x points") {
  for (const double spin : {-370.0, -200.0, -100.0, -1.0, 0.0, 1.0, 100.0, 200.0, 370.0})
    for (const bool backwards : {false, true})
      for (const double yaw : {-1.2, 0.0, 0.7}) {
        INFO(spin << " rad/s, " << backwards << ", yaw " << yaw);
        const Recording recording = spinning(spin, backwards, yaw);
        const Spin with_sign = signed_spin(recording), without = unsigned_spin(recording);
        CHECK(with_sign.valid.head(29).all());
        CHECK(!with_sign.valid[29]);
        CHECK(std::isnan(with_sign.value[29]));
        for (Eigen::Index i = 0; i < 29; ++i) {
          CHECK(with_sign.value[i] == Approx(-spin).margin(1e-9));
          CHECK(without.value[i] == Approx(std::abs(spin)).margin(1e-9));
        }
      }
}

TEST_CASE("The surface under the string of a positive spin moves towards the right tip") {
  const Recording recording = spinning(-50.0);
  REQUIRE(signed_spin(recording).value[0] > 0.0);
  const Eigen::Quaterniond first(Eigen::Vector4d(recording.diabolo_orientation.quaternion.col(0)));
  const Eigen::Quaterniond second(Eigen::Vector4d(recording.diabolo_orientation.quaternion.col(1)));
  const Eigen::Vector3d below(0.0, 0.0, -0.0065);
  const Eigen::Vector3d moved = second * (first.conjugate() * below) - below;
  CHECK(moved.y() < 0.0);  // y is left
}

TEST_CASE("Faster than half a turn per frame, spin folds back") {
  CHECK(largest_spin(120.0) == Approx(2.0 * std::numbers::pi * 60.0));
  const double beyond = largest_spin(120.0) + 10.0;
  CHECK(unsigned_spin(spinning(beyond)).value[0] == Approx(largest_spin(120.0) - 10.0));
  CHECK(signed_spin(spinning(-beyond)).value[0] == Approx(-(largest_spin(120.0) - 10.0)));
}

TEST_CASE("Turning of the axle is spin to the unsigned rule only") {
  Recording recording = spinning(0.0);
  for (Eigen::Index i = 0; i < recording.size(); ++i)
    recording.diabolo_orientation.quaternion.col(i) =
        Eigen::Quaterniond(Eigen::AngleAxisd(3.0 * recording.time[i], Eigen::Vector3d::UnitZ())).coeffs();
  CHECK(unsigned_spin(recording).value[0] == Approx(3.0));
  CHECK(signed_spin(recording).value[0] == Approx(0.0).margin(1e-12));
}

TEST_CASE("Dropouts and gaps leave spin without value") {
  Recording recording = spinning(100.0);
  recording.diabolo_orientation.valid[10] = false;
  recording.diabolo_orientation.quaternion.col(10).setConstant(kNaN);
  recording.time.tail(10).array() += 1.0 / 120.0;
  for (const Spin& spin : {signed_spin(recording), unsigned_spin(recording)}) {
    for (Eigen::Index i = 0; i < 30; ++i) {
      INFO("sample " << i);
      CHECK(spin.valid[i] == (i != 9 && i != 10 && i != 19 && i != 29));
      CHECK(std::isnan(spin.value[i]) == !spin.valid[i]);
    }
  }
  recording.diabolo_orientation = {};
  CHECK(!unsigned_spin(recording).valid.any());
}

TEST_CASE("An axle square to world x has no sign of spin") {
  const Recording recording = spinning(100.0, false, std::numbers::pi / 2.0);
  CHECK(!signed_spin(recording).valid.any());
  CHECK(unsigned_spin(recording).value[0] == Approx(100.0));
}

TEST_CASE("The spin of a cut is the cut of the spin") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  for (std::uint32_t k = 0; k < 50; ++k) {
    const Recording recording = test::random_recording(seed + k);
    const Eigen::Index first = recording.size() / 3;
    const Spin whole = signed_spin(recording),
               part = signed_spin(cut(recording, first, recording.size() - 1));
    for (Eigen::Index i = 0; i < part.value.size(); ++i) {
      CHECK(part.valid[i] == whole.valid[first + i]);
      if (part.valid[i]) CHECK(part.value[i] == whole.value[first + i]);
    }
  }
}
