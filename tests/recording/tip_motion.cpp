// SPDX-License-Identifier: MIT
#include "diabolo/recording/tip_motion.hpp"

#include "catch.hpp"
#include "recording/played.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

namespace {

Recording drop(Recording recording, Track Recording::*track, Eigen::Index first, Eigen::Index last) {
  for (Eigen::Index i = first; i <= last; ++i) {
    (recording.*track).valid[i] = false;
    (recording.*track).position.col(i).setConstant(kNaN);
  }
  return recording;
}

}  // namespace

TEST_CASE("A held pose counts in the first step that begins strictly after its instant") {
  const Recording recording = test::with_tips(300, test::beating_tips(2, 0.0), 120.0);
  for (const Eigen::Index first : {0, 1, 2, 40}) {
    const auto motion = RecordedTips(recording, Interpolation::kHeld).motion(first, 299);
    for (int step = 0; step < 1500; ++step) {
      // In microseconds times 3, so that the comparison is exact: a row is 25000, a step 3000.
      const long begin = 25000L * first + 3000L * (step - 1);
      Eigen::Index row = first;
      while (row < 299 && 25000L * (row + 1) < begin) ++row;
      const double time = static_cast<double>(first) / 120.0 + step * kEvaluationStep;
      REQUIRE(motion->at(time).left == recording.left.position.col(row));
      REQUIRE(motion->at(time).right == recording.right.position.col(row));
    }
  }
}

TEST_CASE("Rows lie at their frame numbers, not at the rounded times of a file") {
  Recording recording = test::with_tips(200, test::beating_tips(3, 0.0), 120.0);
  CHECK(row_times(recording)[199] == 199.0 / 120.0);
  CHECK(recording.time[199] - recording.time[0] != 199.0 / 120.0);
  recording.time[3] += 0.002;  // a sample that really was late: then the times count
  CHECK(row_times(recording)[199] == recording.time[199] - recording.time[0]);
}

TEST_CASE("The tips of a part go by the clock of the whole") {
  Recording whole = test::with_tips(300, test::beating_tips(2, 0.0), 120.0);
  for (const Interpolation kind : {Interpolation::kHeld, Interpolation::kSpline}) {
    const Recording part = cut(cut(whole, 60, 299), 60, 239);
    CHECK(part.clock == Approx(1.0));
    const auto of_whole = RecordedTips(whole, kind).motion(120, 299),
               of_part = RecordedTips(part, kind).motion(0, 179);
    CHECK(of_part->at(0.5).time == Approx(of_whole->at(1.5).time));
    CHECK(of_part->pose(7).time == Approx(of_whole->pose(kind == Interpolation::kHeld ? 7 : 127).time));
  }
}

TEST_CASE("A held tip that is missing stays where it was seen last") {
  const Recording whole = test::with_tips(30, test::beating_tips(4, 0.0), 120.0);
  const TipMotion<double> motion = tip_motion(drop(whole, &Recording::left, 10, 14), Interpolation::kHeld);
  const Tips<double> tips = motion.at(13.0 / 120.0 + 2.0 * kHeldDelay);
  CHECK(tips.left == whole.left.position.col(9));
  CHECK(tips.right == whole.right.position.col(13));
}

TEST_CASE(
    "A gap of one tip leaves the path of the other as it is, and is bridged through the tip's own samples") {
  const Recording whole = test::with_tips(60, test::beating_tips(5, 0.0), 120.0);
  const Recording gap = drop(whole, &Recording::left, 20, 25), no_left_there = [&] {
    Recording recording = whole;  // both tips missing: the left one's path has only its own samples
    return drop(drop(recording, &Recording::left, 20, 25), &Recording::right, 20, 25);
  }();
  for (const Interpolation kind : {Interpolation::kLinear, Interpolation::kSpline}) {
    const TipMotion<double> full = tip_motion(whole, kind), bridged = tip_motion(gap, kind);
    const TipMotion<double> expected = tip_motion(no_left_there, kind);
    for (double time = 0.0; time < 0.5; time += 0.0007) {
      REQUIRE((bridged.at(time).right - full.at(time).right).norm() < 1e-12);
      REQUIRE((bridged.at(time).left - expected.at(time).left).norm() < 1e-12);
      REQUIRE((bridged.at(time).left_velocity - expected.at(time).left_velocity).norm() < 1e-9);
    }
  }
}

TEST_CASE("The tips rest where one of them is not there yet, or no longer") {
  const Recording whole = test::with_tips(30, test::beating_tips(6, 0.0), 120.0);
  const Recording late = drop(drop(whole, &Recording::left, 0, 4), &Recording::right, 26, 29);
  const TipMotion<double> motion = tip_motion(late, Interpolation::kSpline);
  CHECK(motion.begin() == 5.0 / 120.0);
  CHECK(motion.end() == 25.0 / 120.0);
  CHECK(motion.at(0.0).right == whole.right.position.col(5));
}

TEST_CASE("Tips that are never seen, or never together, are refused") {
  const Recording whole = test::with_tips(6, test::beating_tips(7, 0.0), 120.0);
  const Recording never = drop(whole, &Recording::right, 0, 5);
  CHECK(complaint([&] { tip_motion(never, Interpolation::kHeld); }) ==
        "recording \"played\": the right tip is never seen");
  const Recording apart = drop(drop(whole, &Recording::left, 3, 5), &Recording::right, 0, 2);
  CHECK(complaint([&] { tip_motion(apart, Interpolation::kSpline); }) ==
        "recording \"played\": the tips are never seen at the same time");
}
