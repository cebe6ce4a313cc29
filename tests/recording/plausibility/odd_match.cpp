// SPDX-License-Identifier: MIT
#include "diabolo/recording/plausibility/odd_match.hpp"

#include <Eigen/Geometry>
#include <string>

#include "catch.hpp"
#include "diabolo/recording/plausibility/warnings.hpp"
#include "recording/shipped.hpp"

using namespace diabolo;

namespace {

/// The diabolo of the row that many samples later.
Recording shifted(const Recording& r, Eigen::Index by) {
  Recording result = r;
  result.diabolo = Track::missing(r.size());
  for (Eigen::Index i = 0; i + by < r.size(); ++i) {
    result.diabolo.position.col(i) = r.diabolo.position.col(i + by);
    result.diabolo.valid[i] = r.diabolo.valid[i + by];
  }
  return result;
}

/// A row of a body's places taken the other way round.
Recording mirrored(Recording r, Track Recording::*body, int axis) {
  (r.*body).position.row(axis) *= -1.0;
  return r;
}

Recording exchanged(Recording r, Track Recording::*body, int one, int other) {
  (r.*body).position.row(one).swap((r.*body).position.row(other));
  return r;
}

}  // namespace

TEST_CASE("In shipped play the bodies fit each other") {
  for (const char* name : test::kShipped) {
    CAPTURE(name);
    CHECK(odd_shift(test::shipped(name)).empty());
    CHECK(odd_axes(test::shipped(name)).empty());
  }
}

TEST_CASE("Tips that are half a second late are told, and early ones") {
  for (const char* name :
       {"circular_acceleration", "drop_and_catch", "hop", "linear_acceleration", "swing", "throw"}) {
    const Recording r = test::shipped(name);
    CAPTURE(name);
    CHECK(test::has(warnings(shifted(r, 60)), "s earlier than the tips: they are shifted"));
    Recording early = r;
    early.left.position.leftCols(r.size() - 60) = r.left.position.rightCols(r.size() - 60);
    early.right.position.leftCols(r.size() - 60) = r.right.position.rightCols(r.size() - 60);
    early.left.valid.head(r.size() - 60) = r.left.valid.tail(r.size() - 60);
    early.right.valid.head(r.size() - 60) = r.right.valid.tail(r.size() - 60);
    CHECK(test::has(warnings(early), "s later than the tips: they are shifted"));
  }
}

TEST_CASE("A body with an axis the other way round, or two exchanged, is told with the axis") {
  for (const char* name : {"swing", "circular_acceleration"}) {
    const Recording r = test::shipped(name);
    CAPTURE(name);
    CHECK(test::has(warnings(mirrored(r, &Recording::diabolo, 1)),
                    "where the diabolo's y is taken the other way round: check its columns"));
    CHECK(test::has(warnings(exchanged(r, &Recording::diabolo, 0, 1)),
                    "where the diabolo's x and y are exchanged: check its columns"));
  }
  Recording turned = test::shipped("swing");  // so that the tips move along x, too
  const Eigen::AngleAxisd turn(0.6, Eigen::Vector3d::UnitZ());
  for (Track* track : {&turned.left, &turned.right, &turned.diabolo})
    track->position = turn.toRotationMatrix() * track->position;
  CHECK(odd_axes(turned).empty());
  CHECK(
      odd_axes(mirrored(turned, &Recording::left, 0)).find("the left tip's x is taken the other way round") !=
      std::string::npos);
  // Of still hands the string has one length, whatever the axes.
  CHECK(odd_axes(mirrored(test::shipped("hold"), &Recording::diabolo, 0)).empty());
}
