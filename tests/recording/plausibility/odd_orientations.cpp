// SPDX-License-Identifier: MIT
#include "diabolo/recording/plausibility/odd_orientations.hpp"

#include "catch.hpp"
#include "diabolo/recording/plausibility/warnings.hpp"
#include "diabolo/recording/resample.hpp"
#include "recording/played.hpp"
#include "recording/shipped.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

/// Ten seconds of a diabolo that spins from one speed to the other [rad/s], at a rate [Hz].
Recording spinning(double from, double to, double rate) {
  Recording r = test::with_tips(static_cast<Eigen::Index>(10.0 * rate), test::beating_tips(3, 0.2), rate);
  r.diabolo_orientation.valid.setConstant(true);
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const double t = static_cast<double>(i) / rate;
    r.diabolo_orientation.quaternion.col(i) =
        Eigen::Quaterniond(
            Eigen::AngleAxisd(-(from * t + 0.05 * (to - from) * t * t), Eigen::Vector3d::UnitX()))
            .coeffs();
  }
  return r;
}

bool has_spin(const Recording& r) { return signed_spin(r).valid.any(); }

}  // namespace

TEST_CASE("a spin within the band of the rate stays, as near to its end as can be") {
  for (const double rate : {10.0, 30.0, 60.0, 120.0})
    for (const double sense : {1.0, -1.0})
      for (const double share : {0.3, 0.9, 0.99}) {
        CAPTURE(rate, sense, share);
        const double fast = sense * share * largest_spin(rate);
        Recording r = spinning(0.4 * fast, fast, rate), given = r;
        CHECK_FALSE(mask_odd_orientations(r));
        CHECK(test::same(r, given));
      }
}

TEST_CASE("a spin that leaves the band of the rate is not used, and a note says so") {
  for (const double rate : {10.0, 30.0, 60.0, 120.0})
    for (const double sense : {1.0, -1.0}) {
      CAPTURE(rate, sense);
      Recording r = spinning(0.5 * sense * largest_spin(rate), 1.1 * sense * largest_spin(rate), rate);
      CHECK(mask_odd_orientations(r));
      CHECK_FALSE(has_spin(r));
      REQUIRE(r.notes.size() == 1);
      CHECK_THAT(r.notes.front(), Contains("more than half a turn from row to row") && Contains("not used"));
      CHECK_FALSE(mask_odd_orientations(r));
    }
}

TEST_CASE("play that a camera sees too seldom shows no spin, and play that it sees shows it") {
  for (const char* name : test::kShipped) {
    CAPTURE(name);
    Recording r = test::shipped(name);
    CHECK(r.notes.empty());
    CHECK(has_spin(r));
    Recording slow = resample(r, 10.0);
    CHECK(mask_odd_orientations(slow));
    CHECK_FALSE(has_spin(slow));
  }
  Recording twice = resample(test::shipped("circular_acceleration"), 60.0);  // up to 62 of 188 rad/s
  CHECK_FALSE(mask_odd_orientations(twice));
  CHECK(open_spin(twice).empty());
}

TEST_CASE("a spin that stays in another band is warned of, and not used where it seems to reverse") {
  Recording hidden = spinning(-190.0, -140.0, 40.0);  // 251 rad/s are a turn per row
  CHECK_FALSE(mask_odd_orientations(hidden));
  CHECK_THAT(open_spin(hidden), Contains("may as well be -188 to -143 rad/s") && Contains("at 40 Hz"));
  CHECK(test::has(warnings(hidden), "may as well be"));
  Recording reverses = spinning(130.0, 220.0, 30.0);  // 188 rad/s are a turn per row
  CHECK(mask_odd_orientations(reverses));
  CHECK_THAT(reverses.notes.front(), Contains("seems to reverse") && Contains("to 215 rad/s"));
  Recording fast = spinning(130.0, 220.0, 120.0);
  CHECK(open_spin(fast).empty());
}

TEST_CASE("a glitch of one row is no spin beyond the band") {
  Recording r = spinning(100.0, 180.0, 120.0);
  for (const Eigen::Index i : {200, 500, 900})
    r.diabolo_orientation.quaternion.col(i) =
        (Eigen::Quaterniond(Eigen::Vector4d(r.diabolo_orientation.quaternion.col(i))) *
         Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitX()))
            .coeffs();
  CHECK_FALSE(mask_odd_orientations(r));
}

TEST_CASE("orientations that are none of an axle across the string are not used") {
  const Recording right = spinning(100.0, 180.0, 120.0);
  Recording still = right, along = right, order = right;
  for (Eigen::Index i = 0; i < right.size(); ++i) {
    const Eigen::Quaterniond given(Eigen::Vector4d(right.diabolo_orientation.quaternion.col(i)));
    still.diabolo.position.col(i) = Eigen::Vector3d(0.0, 0.0, 1.0 + 1e-3 * static_cast<double>(i % 7));
    still.diabolo.valid[i] = true;
    still.diabolo_orientation.quaternion.col(i) = Eigen::Vector4d(0.0, 0.0, 0.0, 1.0);
    along.diabolo_orientation.quaternion.col(i) =
        (Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()) * given).coeffs();
    order.diabolo_orientation.quaternion.col(i) = Eigen::Vector4d(given.w(), given.x(), given.y(), given.z());
  }
  for (auto& [r, said] : {std::pair{still, "never changes"}, std::pair{along, "points from tip to tip"},
                          std::pair{order, "not the axle, or the quaternions are not in the order"}}) {
    Recording masked = r;
    CHECK(mask_odd_orientations(masked));
    CHECK_FALSE(masked.diabolo_orientation.valid.any());
    CHECK_THAT(masked.notes.front(), Contains(said) && Contains("not used"));
  }
}
