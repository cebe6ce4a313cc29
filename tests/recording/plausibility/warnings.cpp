// SPDX-License-Identifier: MIT
#include "diabolo/recording/plausibility/warnings.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "diabolo/recording/resample.hpp"
#include "recording/played.hpp"

using namespace diabolo;

namespace {

/// Five seconds on beating hands, the diabolo as the consistent model has it.
Recording swing() {
  const Recording tips = test::with_tips(600, test::beating_tips(3, 0.2));
  return test::played_by(consistent_model(), tips, test::hanging(tips, tips.string_length));
}

/// The only warning of a recording; empty where there is none, and "(several)" for more.
std::string only_warning(const Recording& recording) {
  const std::vector<std::string> found = warnings(recording);
  for (const std::string& each : found) UNSCOPED_INFO(each);
  return found.empty() ? "" : found.size() > 1 ? "(several)" : found.front();
}

void scale(Recording& recording, double factor) {
  for (Track* track : {&recording.left, &recording.right, &recording.diabolo}) track->position *= factor;
}

}  // namespace

TEST_CASE("usual play is not odd, a throw neither") {
  CHECK(only_warning(swing()).empty());
  CHECK(only_warning(test::thrown()).empty());
}

TEST_CASE("lengths in other units are odd, though all within 100 m") {
  for (const double unit : {0.01, 1.0 / 0.9144, 1.0 / 0.3048, 10.0, 1.0 / 0.0254}) {
    Recording other = swing();
    scale(other, unit);
    CAPTURE(unit);
    CHECK(only_warning(other).find("wrong units") != std::string::npos);
  }
}

TEST_CASE("what no file tells of the set-up is told once") {
  Recording untold = swing();
  untold.assumed = {"string_length", "diabolo"};
  CHECK(only_warning(untold) ==
        "the string's length (1.46 m) and the diabolo (0.2845 kg) are assumed: no file, calibration or "
        "argument tells them");
  untold.assumed = {"diabolo"};
  CHECK(only_warning(untold) ==
        "the diabolo (0.2845 kg) is assumed: no file, calibration or argument tells it");
}

TEST_CASE("a tip that is long unseen is named, with the time") {
  Recording gap = swing();
  for (Eigen::Index i = 120; i < 180; ++i) {
    gap.right.valid[i] = false;
    gap.right.position.col(i).setConstant(kNaN);
  }
  CHECK(only_warning(gap).find("the right tip is not seen for 0.488 s, from 1.008 s on;") == 0);
}

TEST_CASE("a tip that is lost for good is named, one that comes late is not") {
  Recording lost = swing(), late = lost;
  for (Eigen::Index i = 0; i < 300; ++i) {
    late.left.valid[i] = lost.left.valid[i + 300] = false;
    late.left.position.col(i).setConstant(kNaN);
    lost.left.position.col(i + 300).setConstant(kNaN);
  }
  CHECK(only_warning(lost).find("the left tip is not seen for 2.4 s, from 2.448 s on;") == 0);
  CHECK(only_warning(late).empty());
}

TEST_CASE("a tip that is never seen is named") {
  Recording none = swing();
  none.left = Track::missing(none.size());
  CHECK(only_warning(none) == "the left tip is never seen; nothing can be predicted");
}

TEST_CASE("a diabolo that is never seen is named") {
  Recording none = swing();
  none.diabolo = Track::missing(none.size());
  CHECK(only_warning(none) == "the diabolo is never seen; nothing can be compared");
}

TEST_CASE("rows that are missing are named, with how often") {
  Recording jumps = swing();
  jumps.time.tail(jumps.size() - 100).array() += 0.5;
  jumps.time.tail(jumps.size() - 300).array() += 2.0;
  CHECK(only_warning(jumps) ==
        "34 % of the rows are missing: none for 2.008 s, from 2.948 s on (the longest of 2 times)");
}

TEST_CASE("a diabolo that rests to the last digit beside moving sticks is frozen") {
  Recording frozen = swing();
  for (Eigen::Index i = 200; i <= 320; ++i)
    frozen.diabolo.position.col(i) = Eigen::Vector3d(frozen.diabolo.position.col(200));
  CHECK(only_warning(frozen).find("the diabolo does not move by a digit for 0.96 s, from 1.656 s on") == 0);
  Recording held = swing();
  for (Track* track : {&held.left, &held.right, &held.diabolo})
    for (Eigen::Index i = 0; i < held.size(); ++i)
      track->position.col(i) = Eigen::Vector3d(track->position.col(0));
  CHECK(only_warning(held).empty());
}

TEST_CASE("a short gap is nothing odd") {
  Recording gap = swing();
  for (const Eigen::Index i : {100, 200, 201, 202, 203}) {
    gap.left.valid[i] = false;
    gap.left.position.col(i).setConstant(kNaN);
  }
  CHECK(only_warning(gap).empty());
}

TEST_CASE("a tip that is seen now and then is not unseen for long") {
  Recording sparse = swing();
  for (Eigen::Index i = 0; i < sparse.size(); ++i) {
    if (i % 25 == 0) continue;  // every 0.2 s
    sparse.left.valid[i] = false;
    sparse.left.position.col(i).setConstant(kNaN);
  }
  CHECK(only_warning(sparse).empty());
}

TEST_CASE("a slow recording has all its rows, one that lacks more than one in twenty has not") {
  CHECK(only_warning(resample(swing(), 9.0)).empty());
  for (const int every : {16, 24}) {
    Recording holes = swing();
    for (Eigen::Index i = 0; i < holes.size(); ++i) holes.time[i] += 0.008 * static_cast<double>(i / every);
    CAPTURE(every);
    const std::string found = only_warning(holes);
    const bool told = found.starts_with("6 % of the rows are missing: none for 0.016 s, from ");
    CHECK(told == (every == 16));
    CHECK(found.empty() == (every == 24));
  }
}

TEST_CASE("a string that is slack for a moment is not another string") {
  Recording slack = cut(swing(), 0, 60);
  slack.diabolo.position.row(2).array() += 0.1;
  CHECK(only_warning(slack).empty());
  Recording shorter = swing();
  shorter.string_length = 1.6;
  CHECK(only_warning(shorter).find("another string") != std::string::npos);
}

TEST_CASE("another axis up, and bodies under each other's names, are odd") {
  Recording down = swing();
  for (Track* track : {&down.left, &down.right, &down.diabolo}) track->position.row(2) *= -1.0;
  CHECK(only_warning(down) ==
        "the motion says that -z points up, not z (gravity in flight and on the string)");
  Recording swapped = swing();
  for (Eigen::Index i = 300; i < 340; ++i) swapped.left.position.col(i).swap(swapped.right.position.col(i));
  CHECK(only_warning(swapped) == "bodies jump to each other's places, from 2.456 s to 2.768 s");
}

TEST_CASE("orientations that are none of a spinning diabolo are odd") {
  Recording still = swing();
  for (Eigen::Index i = 0; i < still.size(); ++i)
    still.diabolo_orientation.quaternion.col(i) = Eigen::Vector4d(0.0, 0.0, 0.0, 1.0);
  CHECK(only_warning(still).find("the diabolo's orientation never changes") == 0);
  Recording other = swing();
  for (Eigen::Index i = 0; i < other.size(); ++i) {
    const double angle = 0.8 * static_cast<double>(i);  // 100 rad/s about z, which is not body x
    other.diabolo_orientation.quaternion.col(i) =
        Eigen::Vector4d(0.0, 0.0, std::sin(0.5 * angle), std::cos(0.5 * angle));
  }
  CHECK(only_warning(other).find("the diabolo's body x turns by 0.717 rad from row to row") == 0);
}

TEST_CASE("high throws are not odd, a diabolo on the floor is, though its string is right") {
  Recording throws = swing();
  for (Eigen::Index i = 0; i < throws.size(); ++i)
    if (i % 280 > 80) throws.diabolo.position(2, i) = 3.5;
  CHECK(only_warning(throws).find("above") == std::string::npos);
  Recording dropped = swing();
  for (Eigen::Index i = 200; i < dropped.size(); ++i)
    dropped.diabolo.position.col(i) = Eigen::Vector3d(1.0, 0.001 * static_cast<double>(i % 2), 0.06);
  CHECK(only_warning(dropped).find("or a diabolo that lies elsewhere") != std::string::npos);
}

TEST_CASE("a diabolo that hangs still need not turn, and a slow camera sees large turns") {
  Recording still = test::with_tips(600, test::beating_tips(3, 10.0));
  still = test::played_by(consistent_model(), still, test::hanging(still, still.string_length));
  for (Eigen::Index i = 0; i < still.size(); ++i) {
    still.diabolo.position.col(i) = Eigen::Vector3d(still.diabolo.position.col(0));
    still.diabolo_orientation.quaternion.col(i) = Eigen::Vector4d(0.0, 0.0, 0.0, 1.0);
  }
  CHECK(only_warning(still).empty());
  Recording slow = resample(swing(), 15.0);
  slow.diabolo_orientation.valid.setConstant(true);
  for (Eigen::Index i = 0; i < slow.size(); ++i) {
    const double angle = 0.2 * static_cast<double>(i);  // 3 rad/s
    slow.diabolo_orientation.quaternion.col(i) =
        Eigen::Vector4d(0.0, 0.0, std::sin(0.5 * angle), std::cos(0.5 * angle));
  }
  CHECK(only_warning(slow).empty());
}

TEST_CASE("a tip that rests to the last digit and then jumps was frozen, one that starts to move was not") {
  Recording frozen = swing();
  const Eigen::Vector3d elsewhere = frozen.left.position.col(200) + Eigen::Vector3d(0.0, 0.03, 0.0);
  for (Eigen::Index i = 200; i <= 260; ++i) frozen.left.position.col(i) = elsewhere;
  CHECK(only_warning(frozen).find("the left tip does not move by a digit for 0.48 s") == 0);
  Recording moved = swing();
  for (Eigen::Index i = 0; i < moved.size(); ++i)  // 4 m/s from the first row on
    moved.left.position.col(i) = Eigen::Vector3d(
        0.0, 0.3, 1.0 + 0.032 * static_cast<double>(std::clamp<Eigen::Index>(i - 300, 0, 10)));
  for (const std::string& found : warnings(moved)) CHECK(found.find("frozen") == std::string::npos);
}
