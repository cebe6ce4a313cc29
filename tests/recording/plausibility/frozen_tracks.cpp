// SPDX-License-Identifier: MIT
#include "diabolo/recording/plausibility/frozen_tracks.hpp"

#include "catch.hpp"
#include "recording/played.hpp"
#include "recording/shipped.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

/// From row `first` to `last` all that is tracked stays where it was.
void freeze(Track& track, Eigen::Index first, Eigen::Index last) {
  for (Eigen::Index i = first + 1; i <= last; ++i) {
    track.position.col(i) = track.position.col(first);
    track.valid[i] = track.valid[first];
  }
}

}  // namespace

TEST_CASE("Play that moves stays as it is, in front of a camera and in a simulation") {
  for (const char* name : test::kShipped) {
    Recording r = test::shipped(name);
    CHECK(mask_frozen(r) == 0);
    CHECK(r.notes.empty());
  }
  Recording simulated = test::thrown();
  CHECK(mask_frozen(simulated) == 0);
}

TEST_CASE("A simulation may rest to the last digit: no noise moves it elsewhere") {
  Recording r = test::thrown();
  for (Track* track : {&r.left, &r.right, &r.diabolo}) freeze(*track, 0, r.size() / 2);
  CHECK(mask_frozen(r) == 0);
}

TEST_CASE("Rows that repeat the one before become dropouts, one body's or all") {
  for (const char* name : test::kShipped) {
    Recording all = test::shipped(name), one = all;
    const Eigen::Index half = all.size() / 2, last = all.size() - 1;
    CAPTURE(name);
    for (Track* track : {&all.left, &all.right, &all.diabolo}) {
      track->position.col(half) = Vector3<double>(0.1, 0.2, 0.3);
      track->valid[half] = true;
      freeze(*track, half, last);
    }
    CHECK(mask_frozen(all) == 3 * (last - half));
    CHECK(all.left.valid.head(half).any());
    CHECK_FALSE(all.left.valid.tail(last - half).any());
    REQUIRE(all.notes.size() == 1);
    CHECK_THAT(all.notes.front(), Contains("left tip") && Contains("right tip") && Contains("diabolo"));
    one.diabolo.valid[half] = true;
    one.diabolo.position.col(half) = Vector3<double>(0.1, 0.2, 0.3);
    freeze(one.diabolo, half, last);
    CHECK(mask_frozen(one) == last - half);
    CHECK(one.left.valid.tail(last - half).any());
  }
}

TEST_CASE("A few equal rows are no frozen track") {
  Recording r = test::shipped(test::kShipped[0]);
  freeze(r.left, 100, 104);
  CHECK(mask_frozen(r) == 0);
}

TEST_CASE("a coordinate that is the same in all rows was not recorded, in front of a camera") {
  for (const int axis : {0, 1, 2}) {
    Recording r = test::shipped(test::kShipped[0]);
    CHECK(constant_coordinate(r).empty());
    r.right.position.row(axis).setConstant(0.25);
    CHECK_THAT(constant_coordinate(r),
               Contains(std::string("the right tip's ") + "xyz"[axis] + " is 0.25 m in all rows"));
  }
  CHECK(constant_coordinate(test::thrown()).empty());
}
