// SPDX-License-Identifier: MIT
#include "diabolo/recording/plausibility/marker_jumps.hpp"

#include <random>

#include "catch.hpp"
#include "recording/played.hpp"
#include "recording/shipped.hpp"
#include "recording/support.hpp"

using namespace diabolo;

namespace {

Eigen::Vector3d off_by(double metres, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return metres * Eigen::Vector3d(normal(generator), normal(generator), normal(generator)).normalized();
}

}  // namespace

TEST_CASE("One sample in a hundred that is off by 0.5 m becomes a dropout, no other") {
  // With the others, jumps lay two samples apart before a dropout, or made bodies look swapped.
  const std::uint32_t seed = GENERATE(test::fresh_seed(), 442245303u, 412u, 655u);
  std::mt19937 generator(seed);
  std::bernoulli_distribution jumps(0.01);
  int made = 0, found = 0;
  for (const char* name : test::kShipped) {
    Recording r = test::shipped(name);
    const Recording given = r;
    for (Track* track : {&r.left, &r.right, &r.diabolo})
      for (Eigen::Index i = 0; i < r.size(); ++i)
        if (track->valid[i] && jumps(generator)) track->position.col(i) += off_by(0.5, generator);
    const Recording broken = r;
    mask_jumps(r);
    for (const auto track : {&Recording::left, &Recording::right, &Recording::diabolo})
      for (Eigen::Index i = 0; i < r.size(); ++i) {
        if (!(given.*track).valid[i]) continue;
        const bool is_off = (broken.*track).position.col(i) != (given.*track).position.col(i);
        CAPTURE(name, i);
        if (!is_off) CHECK((r.*track).valid[i]);
        made += is_off;
        found += is_off && !(r.*track).valid[i];
      }
    CHECK(r.notes.size() == 1);
  }
  CAPTURE(made);
  CHECK(found > 0.95 * made);
}

TEST_CASE("Play without jumps stays as it is") {
  for (const char* name : test::kShipped) {
    Recording r = test::shipped(name);
    CHECK(mask_jumps(r) == 0);
    CHECK(r.notes.empty());
  }
  Recording thrown = test::thrown();
  CHECK(mask_jumps(thrown) == 0);
}

TEST_CASE("A kick is no jump, nor is a tip that is swung hard, at any rate") {
  for (const double rate : {60.0, 120.0, 240.0}) {
    Recording r = test::with_tips(
        static_cast<Eigen::Index>(2.0 * rate),
        [](double t) {
          Tips<double> tips;  // bounced at 8 m/s: 16 m/s of change; swung at 150 m/s^2
          tips.left = Vector3<double>(0.0, 0.3, 1.0 + 8.0 * std::abs(t - 1.0));
          tips.right = Vector3<double>(0.25 * std::sin(24.5 * t), -0.3, 1.0);
          return tips;
        },
        rate);
    r.diabolo = r.left;
    CAPTURE(rate);
    CHECK(mask_jumps(r) == 0);
  }
}

TEST_CASE("Jumps of a few samples, and beside dropouts, are found; a body that stays elsewhere is not") {
  Recording r = test::shipped("swing");
  for (Eigen::Index i = 0; i < r.size(); ++i)  // tracked throughout
    for (Track* track : {&r.left, &r.right, &r.diabolo})
      if (!track->valid[i] && i > 0)
        track->position.col(i) = track->position.col(i - 1), track->valid[i] = true;
  const Recording given = r;
  for (Eigen::Index i = 200; i < 204; ++i) r.left.position.col(i).x() += 0.3;
  r.left.position.col(300).z() -= 0.5;
  r.left.valid[301] = false;
  r.left.position.col(301).setConstant(kNaN);
  CHECK(mask_jumps(r) == 5);
  CHECK((!r.left.valid.segment(200, 4)).all());
  CHECK(!r.left.valid[300]);
  CHECK(r.notes.front().find("(left tip 5)") != std::string::npos);
  CHECK((!r.left_orientation.valid.segment(200, 4)).all());
  Recording elsewhere = given;
  elsewhere.right.position.rightCols(400).row(0).array() += 0.5;
  CHECK(mask_jumps(elsewhere) == 0);
}

TEST_CASE("A jump, one good sample and another jump do not cost what follows, a dropout near or far") {
  const Recording swing = test::shipped("swing");
  Eigen::Index begin = 300;  // ten samples, all tracked
  while (!swing.left.valid.segment(begin, 10).all()) ++begin;
  for (const Eigen::Index left_over : {1, 2, 4, 6}) {
    Recording r = swing;
    r.left.position.col(begin + 1).z() -= 0.5;
    r.left.position.col(begin + 3).y() += 0.5;
    r.left.valid[begin + 4 + left_over] = false;
    r.left.position.col(begin + 4 + left_over).setConstant(kNaN);
    CAPTURE(left_over);
    CHECK(mask_jumps(r) == 2);
    CHECK(r.left.valid.segment(begin + 4, left_over).all());
  }
}

TEST_CASE("Bodies under each other's names for a few samples are no jumps") {
  Recording r = test::shipped("swing");
  for (Eigen::Index i = 500; i < 504; ++i) {
    r.left.position.col(i).swap(r.right.position.col(i));
    std::swap(r.left.valid[i], r.right.valid[i]);
  }
  CHECK(mask_jumps(r) == 0);
}
