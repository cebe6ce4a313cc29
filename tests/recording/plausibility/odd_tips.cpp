// SPDX-License-Identifier: MIT
#include "diabolo/recording/plausibility/odd_tips.hpp"

#include <Eigen/Geometry>
#include <numbers>
#include <utility>
#include "catch.hpp"
#include "diabolo/recording/plausibility/warnings.hpp"
#include "recording/played.hpp"
#include "recording/shipped.hpp"

using namespace diabolo;

namespace {

void hold_still(Recording& r, Track& tip, Eigen::Index from = 0) {
  Eigen::Index seen = from;
  while (!tip.valid[seen]) ++seen;
  const Eigen::Vector3d place = tip.position.col(seen);
  for (Eigen::Index i = from; i < r.size(); ++i) tip.position.col(i) = place, tip.valid[i] = true;
}

Recording tips_turned_by(Recording r, double degrees) {
  const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ());
  for (Track* track : {&r.left, &r.right, &r.diabolo})
    track->position = turn.toRotationMatrix() * track->position;
  return r;
}

}  // namespace

TEST_CASE("Shipped play is neither frozen nor too wide, nor are tips that rest in a simulation") {
  for (const char* name : test::kShipped) {
    const Recording r = test::shipped(name);
    CAPTURE(name);
    CHECK(odd_still_tips(r, falls(r)).empty());
    CHECK(odd_distance(r).empty());
  }
  // Tips that rest exactly while the diabolo flies over them, farther than the string reaches, and is caught.
  const Recording at_rest = test::with_tips(500, [](double) {
    Tips<double> tips;
    tips.left = Vector3<double>(0.0, 0.71, 1.0);
    tips.right = Vector3<double>(0.0, -0.71, 1.0);
    return tips;
  });
  State<double> start;
  start.position = Vector3<double>(0.0, 0.01, 0.95);
  start.velocity = Vector3<double>(0.0, 0.02, 3.5);
  start.string_state = StringState::kLoose;
  const Recording thrown = test::played_by(consistent_model(), at_rest, start);
  CHECK(thrown.time.tail(1)[0] - thrown.time[0] > kFewestSeconds);
  CHECK(odd_still_tips(thrown, falls(thrown)).empty());
}

TEST_CASE("Frozen tips are told, one or both, and from some row on") {
  for (const char* name : {"circular_acceleration", "drop_and_catch", "linear_acceleration", "throw"}) {
    CAPTURE(name);
    Recording left = test::shipped(name), both = left, late = left;
    hold_still(left, left.left);
    CHECK(test::has(warnings(left), "the left tip rests to the last digit for "));
    hold_still(both, both.left);
    hold_still(both, both.right);
    CHECK(test::has(warnings(both), "the left tip and the right tip rest to the last digit for "));
    hold_still(late, late.right, late.size() / 2);
    CHECK(test::has(warnings(late), "the right tip rests to the last digit for "));
  }
}

TEST_CASE("Tips farther apart than the string are told") {
  Recording r = test::shipped("hold");
  r.left.position.row(1).array() += 2.0;
  CHECK(odd_distance(r).find(
            "the tips are farther apart than the string is long, 1.45 m, in 100 % of the rows") == 0);
}

TEST_CASE(
    "A frame that is turned by right angles about the vertical is told, one turned by 30 degrees is not") {
  for (const char* name : test::kShipped) {
    const Recording given = test::shipped(name);
    CAPTURE(name);
    CHECK(odd_heading(given).empty());
    for (const auto& [degrees, odd] : {std::pair{90.0, true}, {-90.0, true}, {180.0, true}, {30.0, false}})
      CHECK(odd_heading(tips_turned_by(given, degrees)).empty() != odd);
  }
}

TEST_CASE("A frame that is turned by half a right angle or more is told with the angle") {
  Recording given = test::shipped("swing");
  given.left_orientation.valid.setConstant(false);  // else they tell that the sticks are exchanged
  for (const double degrees : {50.0, 60.0, -55.0, 65.0, 120.0}) {
    CAPTURE(degrees);
    const std::string told = odd_heading(tips_turned_by(given, degrees));
    CHECK(told.find("the frame is turned by some ") != std::string::npos);
    CHECK(std::abs(std::stod(told.substr(told.find("some ") + 5)) - std::abs(degrees)) < 5.0);
  }
}

TEST_CASE("What is said of exchanged sticks is one sentence, which a diagnosis does not contradict") {
  const Recording given = test::shipped("swing"), exchanged = with_sticks_exchanged(given);
  const auto told = [](const Recording& r) {
    std::vector<std::string> found;
    for (const std::string& one : warnings(r))
      if (one.find("the left ") != std::string::npos) found.push_back(one);
    REQUIRE(found.size() == 1);
    return found.front();
  };
  CHECK(told(exchanged) ==
        "seen along the sticks, the left one is on the right: they are under each other's names");
  // Directions inwards: a diagnosis leaves such sticks as they are.
  Recording inwards = given;
  for (OrientationTrack* track : {&inwards.left_orientation, &inwards.right_orientation})
    for (Eigen::Index i = 0; i < track->quaternion.cols(); ++i) {
      const Eigen::Quaterniond turn(Eigen::Vector4d(track->quaternion.col(i)));
      track->quaternion.col(i) =
          (turn * Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ())).coeffs();
    }
  CHECK(told(inwards).starts_with("the left tip lies on the left, but not as seen along the sticks"));
}
