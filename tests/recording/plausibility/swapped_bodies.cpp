// SPDX-License-Identifier: MIT
#include "diabolo/recording/plausibility/swapped_bodies.hpp"

#include <cmath>

#include "catch.hpp"
#include "diabolo/recording/check.hpp"

using namespace diabolo;

namespace {

/// Hands that beat and a diabolo below them, ten seconds at 120 Hz.
Recording played() {
  Recording r;
  const Eigen::Index size = 1200;
  r.name = "played";
  r.rate = 120.0;
  r.time = Eigen::VectorXd::LinSpaced(size, 0.0, static_cast<double>(size - 1) / r.rate);
  for (Track* track : {&r.left, &r.right, &r.diabolo}) {
    track->position.resize(3, size);
    track->valid = Marks::Constant(size, true);
  }
  r.diabolo_orientation = OrientationTrack::missing(size);
  r.left_orientation = r.right_orientation = OrientationTrack::missing(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const double beat = 0.1 * std::sin(9.0 * r.time[i]);
    r.left.position.col(i) << 0.0, 0.3, 1.2 + beat;
    r.right.position.col(i) << 0.0, -0.3, 1.2 - beat;
    r.diabolo.position.col(i) << 0.02 * std::cos(5.0 * r.time[i]), beat, 0.6;
    r.diabolo_orientation.valid[i] = true;
    r.diabolo_orientation.quaternion.col(i) << 1.0, 0.0, 0.0, 0.0;
    r.left_orientation.valid[i] = r.right_orientation.valid[i] = true;
    r.left_orientation.quaternion.col(i) << 0.0, 1.0, 0.0, 0.0;
    r.right_orientation.quaternion.col(i) << 0.0, 0.0, 1.0, 0.0;
  }
  return r;
}

bool same(const Recording& a, const Recording& b) {
  return a.left.position == b.left.position && a.right.position == b.right.position &&
         a.diabolo.position == b.diabolo.position &&
         a.left_orientation.quaternion == b.left_orientation.quaternion &&
         a.diabolo_orientation.quaternion == b.diabolo_orientation.quaternion;
}

void exchange(Track& a, Track& b, OrientationTrack& p, OrientationTrack& q, Eigen::Index first,
              Eigen::Index last) {
  for (Eigen::Index i = first; i <= last; ++i) {
    a.position.col(i).swap(b.position.col(i));
    std::swap(a.valid[i], b.valid[i]);
    p.quaternion.col(i).swap(q.quaternion.col(i));
    std::swap(p.valid[i], q.valid[i]);
  }
}

}  // namespace

TEST_CASE("bodies under their own names stay") {
  const Recording given = played();
  Recording r = given;
  CHECK(unswap(r).count == 0);
  CHECK(same(r, given));
}

TEST_CASE("bodies that were recorded under each other's names for a while get them back") {
  const Recording given = played();
  Recording r = given;
  exchange(r.left, r.diabolo, r.left_orientation, r.diabolo_orientation, 200, 260);
  exchange(r.left, r.right, r.left_orientation, r.right_orientation, 700, 1000);
  CHECK_FALSE(same(r, given));
  const Swaps swaps = unswap(r);
  CHECK(same(r, given));
  CHECK(swaps.count == 61 + 301);
  REQUIRE(swaps.rows.size() == 2);
  CHECK(swaps.rows[0] == std::pair<Eigen::Index, Eigen::Index>(200, 260));
  CHECK(swaps.rows[1] == std::pair<Eigen::Index, Eigen::Index>(700, 1000));
}

TEST_CASE("what is given back keeps its dropouts") {
  Recording r = played();
  for (const Eigen::Index row : {230, 231}) {  // of the stick under the diabolo's name
    r.left_orientation.valid[row] = r.left.valid[row] = false;
    r.left_orientation.quaternion.col(row).setConstant(kNaN);
    r.left.position.col(row).setConstant(kNaN);
  }
  exchange(r.left, r.diabolo, r.left_orientation, r.diabolo_orientation, 200, 260);
  CHECK(unswap(r).count == 61);
  for (Eigen::Index i = 0; i < r.size(); ++i) r.frame.push_back(i);
  CHECK_NOTHROW(check_recording(r));
  CHECK_FALSE(r.left_orientation.valid[230]);
  CHECK(r.diabolo_orientation.valid[230]);
}

TEST_CASE("a jump of one body alone is no exchange") {
  Recording r = played();
  for (Eigen::Index i = 400; i < 420; ++i) r.diabolo.position(2, i) += 1.0;
  const Recording jumped = r;
  CHECK(unswap(r).count == 0);
  CHECK(same(r, jumped));
}

TEST_CASE("an exchange across a dropout is found as soon as two bodies are seen again") {
  const Recording given = played();
  Recording r = given;
  exchange(r.left, r.diabolo, r.left_orientation, r.diabolo_orientation, 303, 360);
  for (Eigen::Index i = 300; i < 303; ++i) r.left.valid[i] = r.diabolo.valid[i] = false;
  CHECK(unswap(r).count == 58);
  CHECK(r.left.position.col(330) == given.left.position.col(330));
}

namespace {

/// Sticks that point along `left` and `right`, horizontally.
Recording pointing(double left_degrees, double right_degrees) {
  Recording r = played();
  const auto turn = [&](OrientationTrack& track, double degrees) {
    const double half = 0.5 * degrees / 180.0 * 3.14159265358979;
    track.quaternion.colwise() = Eigen::Vector4d(0.0, 0.0, std::sin(half), std::cos(half));
  };
  turn(r.left_orientation, left_degrees);
  turn(r.right_orientation, right_degrees);
  return r;
}

/// The player and all that is played, turned about the vertical.
Recording turned(Recording r, double degrees) {
  const double angle = degrees / 180.0 * 3.14159265358979;
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  r.left.position = (rotation * r.left.position).eval();
  r.right.position = (rotation * r.right.position).eval();
  for (OrientationTrack* track : {&r.left_orientation, &r.right_orientation})
    for (Eigen::Index i = 0; i < r.size(); ++i)
      track->quaternion.col(i) =
          (Eigen::Quaterniond(rotation) * Eigen::Quaterniond(Eigen::Vector4d(track->quaternion.col(i))))
              .coeffs();
  return r;
}

}  // namespace

TEST_CASE("sticks under each other's names lie on each other's sides, whichever way the player looks") {
  const Recording given = pointing(-10.0, 15.0);
  for (const double degrees : {0.0, 77.0, 180.0, 250.0}) {
    const Recording r = turned(given, degrees);
    CHECK(sticks_are_exchanged(r) == std::optional<bool>(false));
    CHECK(sticks_are_exchanged(with_sticks_exchanged(r)) == std::optional<bool>(true));
  }
}

TEST_CASE(
    "sides say nothing of sticks that face each other, are crossed for a while, or were not seen to point") {
  CHECK(!sticks_are_exchanged(pointing(-80.0, 80.0)));
  Recording crossed = pointing(0.0, 0.0);
  crossed.left.position.leftCols(300).row(1).setConstant(-0.4);
  CHECK(!sticks_are_exchanged(crossed));
  Recording unseen = pointing(0.0, 0.0);
  unseen.left_orientation.valid.head(700).setConstant(false);
  CHECK(!sticks_are_exchanged(unseen));
  unseen.left_orientation = {};
  CHECK(!sticks_are_exchanged(unseen));
}
