// SPDX-License-Identifier: MIT
#include "diabolo/recording/warnings.hpp"

#include "catch.hpp"
#include "played.hpp"

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

TEST_CASE("a tip that is long unseen is named, with the time") {
  Recording gap = swing();
  for (Eigen::Index i = 120; i < 180; ++i) {
    gap.right.valid[i] = false;
    gap.right.position.col(i).setConstant(kNaN);
  }
  CHECK(only_warning(gap).find("the right tip is not seen for 0.488 s, from 1.008 s on;") == 0);
  Recording late = swing();
  for (Eigen::Index i = 0; i < 60; ++i) {
    late.left.valid[i] = false;
    late.left.position.col(i).setConstant(kNaN);
  }
  CHECK(only_warning(late).find("the left tip is not seen for 0.48 s, from 0.056 s on;") == 0);
}

TEST_CASE("rows that are missing are named, with how often") {
  Recording jumps = swing();
  jumps.time.tail(jumps.size() - 100).array() += 0.5;
  jumps.time.tail(jumps.size() - 300).array() += 2.0;
  CHECK(only_warning(jumps) == "there are no rows for 2.008 s, from 2.948 s on (the longest of 2 times)");
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
