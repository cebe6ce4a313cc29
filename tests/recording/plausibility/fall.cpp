// SPDX-License-Identifier: MIT
#include "diabolo/recording/plausibility/fall.hpp"

#include "catch.hpp"
#include "diabolo/recording/formats/up_axis.hpp"
#include "diabolo/recording/plausibility/warnings.hpp"
#include "recording/shipped.hpp"
#include "recording/support.hpp"

using namespace diabolo;

namespace {

/// The recording in a frame in which `up` is what z was.
Recording in_frame(const Recording& r, const UpAxis& up) {
  const Eigen::Matrix3d turn = turn_to_z_up(up).transpose();
  Recording result = r;
  for (Track* track : {&result.left, &result.right, &result.diabolo})
    for (Eigen::Index i = 0; i < r.size(); ++i)
      track->position.col(i) = Eigen::Vector3d(turn * track->position.col(i));
  return result;
}

Recording played_faster(Recording r, double factor) {
  r.time /= factor;
  r.rate *= factor;
  return r;
}

}  // namespace

TEST_CASE("Shipped play falls as it should, along z") {
  for (const char* name : test::kShipped) {
    const Recording r = test::shipped(name);
    CAPTURE(name);
    CHECK(!other_axis_up(r, falls(r)));
    CHECK(odd_fall(r, falls(r)).empty());
  }
}

TEST_CASE("The axis that points up shows in any play, also where the hands are still") {
  for (const char* name : test::kShipped)
    for (const int axis : {1, -1, 2, -2, -3}) {
      const Recording r = in_frame(test::shipped(name), {axis, false});
      CAPTURE(name, axis);
      CHECK(other_axis_up(r, falls(r)) == axis);
    }
}

TEST_CASE("Lengths that are wrong are no frame that is") {
  Recording r = test::shipped("hold");
  r.diabolo.position *= 3.0;  // above the tips
  CHECK(!other_axis_up(r, falls(r)));
}

TEST_CASE("Axes may be those of a file that is turned about z") {
  const Recording r = in_frame(test::shipped("hop"), {2, false});
  Eigen::Matrix3d quarter;  // y of the recording is x of the file, x its -y
  quarter << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  CHECK(other_axis_up(r, falls(r), quarter) == 1);
}

TEST_CASE("An acceleration across the string is gravity's alone") {
  const Fall slack{0, {0.0, 0.0, -9.8}, Eigen::Vector3d::Zero()};
  CHECK(slack.residual({0.0, 0.0, -9.8}) == 0.0);
  const Fall held{0, Eigen::Vector3d::Zero(), {0.0, 0.0, 1.5}};
  CHECK(held.residual({0.0, 0.0, -9.8}) == 0.0);
  CHECK(held.residual({0.0, 0.0, 9.8}) == Approx(9.8));  // a string does not push
  CHECK(held.residual({0.0, 3.0, -9.8}) == Approx(3.0));
}

TEST_CASE("Play at another speed falls otherwise") {
  for (const char* name : {"swing", "throw", "circular_acceleration", "drop_and_catch"}) {
    const Recording twice = played_faster(test::shipped(name), 2.0),
                    half = played_faster(test::shipped(name), 0.5);
    CAPTURE(name);
    CHECK(test::has(warnings(twice), "times as fast (a wrong rate)"));
    CHECK(test::has(warnings(half), "times as fast (a wrong rate)"));
  }
}

TEST_CASE("Rows too far apart, too few or random tell nothing") {
  const Recording slow = test::random_recording(3);
  CHECK(!other_axis_up(slow, falls(slow)));
  CHECK(odd_fall(slow, falls(slow)).empty());
  Recording apart = test::shipped("hop");
  apart.time *= 120.0 / 5.0;
  apart.rate = 5.0;
  CHECK(falls(apart).empty());
  CHECK(!other_axis_up(apart, falls(apart)));
  Recording empty;
  empty.rate = 120.0;
  CHECK(falls(empty).empty());
}

TEST_CASE("The real takes fall as they should") {
  const auto folder = test::recordings_folder("gravity in the real takes");
  if (!folder) return;
  for (const auto& entry : std::filesystem::directory_iterator(*folder / "2020-07-11_basic_physics")) {
    if (entry.path().extension() != ".csv") continue;
    const Recording r = load_recording(entry.path());
    CAPTURE(entry.path().string());
    CHECK(!other_axis_up(r, falls(r)));
    CHECK(odd_fall(r, falls(r)).empty());
    CHECK(r.notes.empty());
    const Recording turned = in_frame(r, {2, false});
    CHECK(other_axis_up(turned, falls(turned)) == 2);
  }
}
