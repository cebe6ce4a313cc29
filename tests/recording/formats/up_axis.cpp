// SPDX-License-Identifier: MIT
#include "diabolo/recording/formats/up_axis.hpp"

#include <numbers>

#include "catch.hpp"
#include "recording/shipped.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

namespace {

/// As a capture writes it in whose frame another axis points up: the opposite turn.
Recording written_with(const Recording& r, const UpAxis& up) {
  return turned(r, turn_to_z_up(up).transpose());
}

Recording turned_by(const Recording& r, double degrees) {
  return turned(
      r, Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ()).toRotationMatrix());
}

}  // namespace

TEST_CASE("Names of axes read back, others are refused") {
  for (const char* text : {"x", "y", "z", "-x", "-y", "-z", "y-mirrored", "-z-mirrored"})
    CHECK(text_of(up_axis_of(text)) == text);
  CHECK(complaint([] { up_axis_of("w"); }) ==
        "up: \"w\"; expected x, y, z, -x, -y or -z, with -mirrored behind it for a left-handed frame");
}

TEST_CASE("A turn brings the axis up, and is a reflection only where the frame is mirrored") {
  for (const int axis : {1, 2, 3, -1, -2, -3})
    for (const bool mirrored : {false, true}) {
      const Eigen::Matrix3d turn = turn_to_z_up({axis, mirrored});
      CAPTURE(axis, mirrored);
      CHECK(turn.determinant() == (mirrored ? -1.0 : 1.0));
      CHECK(turn * turn.transpose() == Eigen::Matrix3d::Identity());
      CHECK((turn.row(2) * Eigen::Vector3d::Unit(std::abs(axis) - 1))(0) == (axis > 0 ? 1.0 : -1.0));
    }
  CHECK(turn_to_z_up({3, false}) == Eigen::Matrix3d::Identity());
  // Motive: x right, y up, z towards the player.
  CHECK(turn_to_z_up({2, false}) * Eigen::Vector3d(1.0, 2.0, 3.0) == Eigen::Vector3d(1.0, -3.0, 2.0));
  // y and z exchanged
  CHECK(turn_to_z_up({2, true}) * Eigen::Vector3d(1.0, 2.0, 3.0) == Eigen::Vector3d(1.0, 3.0, 2.0));
}

TEST_CASE("Another axis up is refused with the way to read it, and read so it is the same play") {
  const test::TemporaryFolder folder;
  for (const UpAxis up : {UpAxis{2, false}, UpAxis{2, true}, UpAxis{-1, false}, UpAxis{-3, false}}) {
    const Recording given = test::shipped("hop");
    save_tidy(written_with(given, up), folder / "hop.csv");
    CAPTURE(text_of(up));
    const std::string said = complaint([&] { load_recording(folder / "hop.csv"); });
    CHECK(said.find("hop.csv: the motion says that " + text_of({up.axis, false}) + " points up, not z") !=
          std::string::npos);
    CHECK(said.find("read it with --up=" + text_of({up.axis, false})) != std::string::npos);
    CHECK((said.find("with --up=" + text_of({up.axis, true})) != std::string::npos) == up.mirrored);
    CHECK(said.ends_with(", or with --up=z as it stands"));
    const Recording turned = load_recording(folder / "hop.csv", published_calibration(), {up, {}});
    CHECK(test::same(turned.diabolo, given.diabolo));
    CHECK(test::same(turned.left, given.left));
    for (Eigen::Index i = 0; i < given.size(); ++i) {
      if (!given.diabolo_orientation.valid[i]) continue;
      const double same =
          given.diabolo_orientation.quaternion.col(i).dot(turned.diabolo_orientation.quaternion.col(i));
      CHECK(std::abs(same) == Approx(1.0).epsilon(1e-9));
    }
    CHECK(turned.notes.empty());
    // As it stands, on demand.
    const Recording standing = load_recording(folder / "hop.csv", published_calibration(), {UpAxis{}, {}});
    CHECK(standing.size() == given.size());
  }
}

TEST_CASE("The real takes are read as before, and turned ones are refused by the capture's axis") {
  const auto folder = test::recordings_folder("turned takes");
  if (!folder) return;
  const TrackedTake take = load_motive(*folder / "2020-07-11_basic_physics/z_hop_1.csv");
  TrackedTake y_up = take;
  Eigen::Matrix4Xd none(4, 0);
  for (TrackedBody& body : y_up.bodies)
    recording_formats_detail::turn_frame(turn_to_z_up({2, false}).transpose(), body.position,
                                         body.quaternion);
  const Calibration calibration = published_calibration();
  const std::string said =
      complaint([&] { check_up(apply(calibration, y_up), calibration.world_yaw, "z_hop_1.csv"); });
  CHECK(said.find("the motion says that y points up, not z") != std::string::npos);
  CHECK(said.find("--up=y,") != std::string::npos);
  const Recording given = apply(calibration, take),
                  turned = apply(calibration, turned_to_z_up(y_up, {2, false}));
  CHECK((given.left.position - turned.left.position)
            .array()
            .isNaN()
            .select(0.0, (given.left.position - turned.left.position).array())
            .abs()
            .maxCoeff() < 1e-12);
}

TEST_CASE("A player who faces along another axis is turned to face along x") {
  const Recording given = test::shipped("swing");
  REQUIRE(sticks_are_exchanged(given) == false);
  const auto is_as_given = [&](const Recording& r) {
    return (r.diabolo.position - given.diabolo.position).cwiseAbs().maxCoeff() < 1e-12 &&
           (r.right.position - given.right.position).cwiseAbs().maxCoeff() < 1e-12;
  };
  CHECK(turned_to_face_forward(given).notes.empty());
  for (const double degrees : {90.0, -90.0, 180.0}) {
    CAPTURE(degrees);
    const Recording r = turned_to_face_forward(turned_by(given, degrees));
    CHECK(is_as_given(r));
    REQUIRE(r.notes.size() == 1);
    CHECK(r.notes.front().starts_with("the left tip does not lie to the left, along y: all is turned by "));
  }
  CHECK(turned_to_face_forward(turned_by(given, 30.0)).notes.empty());
  // By half a turn, or exchanged: without the sticks' directions nobody knows.
  Recording plain = turned_by(given, 180.0);
  plain.left_orientation.valid.setConstant(false);
  CHECK(turned_to_face_forward(plain).notes.empty());
  CHECK(odd_heading(plain).starts_with("the left tip lies to the right of the right one"));
}

TEST_CASE("A quarter turn about the vertical takes the spin's sign from no reader") {
  const test::TemporaryFolder folder;
  const Recording given = test::shipped("swing");
  save_tidy(turned_by(given, 90.0), folder / "swing.csv");
  const Recording read = load_recording(folder / "swing.csv");
  const Spin before = signed_spin(given), after = signed_spin(read);
  CHECK(before.valid.count() == after.valid.count());
  for (Eigen::Index i = 0; i < given.size(); ++i)
    if (before.valid[i]) CHECK(after.value[i] == Approx(before.value[i]).margin(1e-3));
}

TEST_CASE("Another axis up beside a player who is turned is no mirrored frame, if the sticks tell") {
  const test::TemporaryFolder folder;
  save_tidy(written_with(turned_by(test::shipped("swing"), 180.0), {2, false}), folder / "swing.csv");
  const std::string said = complaint([&] { load_recording(folder / "swing.csv"); });
  CHECK(said.ends_with("; read it with --up=y, or with --up=z as it stands"));
  Recording plain = turned_by(test::shipped("swing"), 180.0);
  plain.left_orientation = plain.right_orientation = OrientationTrack::missing(plain.size());
  save_tidy(written_with(plain, {2, false}), folder / "plain.csv");
  const std::string both = complaint([&] { load_recording(folder / "plain.csv"); });
  CHECK(both.find("with --up=y where the player is turned or the sticks are exchanged, with --up=y-mirrored "
                  "where the frame is mirrored") != std::string::npos);
}
