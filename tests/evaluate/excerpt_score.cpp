// SPDX-License-Identifier: MIT
#include "diabolo/evaluate/excerpt_score.hpp"

#include "catch.hpp"
#include "diabolo/json/recording_file.hpp"
#include "recording/played.hpp"
#include "recording/support.hpp"

using namespace diabolo;
using test::complaint;

namespace {

/// Without gravity the published start is exact for a diabolo that is free for the first frame.
Model weightless(Model model) {
  model.parameters.gravity = 0.0;
  return model;
}

State<double> drifting(Random& random, const Recording& recording) {
  State<double> state;
  state.position = 0.5 * (recording.left.position.col(0) + recording.right.position.col(0)) +
                   Eigen::Vector3d(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), -0.3);
  state.velocity = random.vector(0.7);
  state.velocity.z() = -1.0;
  state.spin = 60.0;
  return state;
}

}  // namespace

TEST_CASE("A model scores zero on what it predicts itself") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  Random random(seed);
  for (const Model& model : {published_model(), paper_model(), consistent_model()})
    for (std::uint32_t k = 0; k < 5; ++k) {
      const Recording tips = test::with_tips(240, test::beating_tips(seed + k, 0.0));
      const Recording recording = test::played_by(weightless(model), tips, drifting(random, tips));
      const ExcerptScore score = score_excerpt(recording, weightless(model));
      CAPTURE(model.name, k);
      REQUIRE(score.error);
      CHECK(*score.error < 1e-6);
      CHECK(score.baseline_error > 0.01);
      CHECK(score.scored == 238);
      CHECK(score.duration == Approx(238.0 / 125.0));
    }
}

TEST_CASE("A diabolo at rest on resting tips costs the baseline and the consistent model nothing") {
  Recording recording = test::with_tips(200, test::beating_tips(3, 10.0));
  recording.string_length = kBaselineStringLength;
  recording = test::played_by(consistent_model(), recording, test::hanging(recording, kBaselineStringLength));
  const ExcerptScore score = score_excerpt(recording, consistent_model());
  REQUIRE(score.error);
  CHECK(*score.error < 1e-9);
  CHECK(score.baseline_error < 1e-9);
}

TEST_CASE("A score can be called off") {
  Recording recording = test::with_tips(200, test::beating_tips(3, 10.0));
  recording = test::played_by(consistent_model(), recording, test::hanging(recording, kBaselineStringLength));
  int asked = 0;
  const Watch watch{.progress = {}, .cancelled = [&] { return ++asked > 3; }};
  CHECK_THROWS_AS(score_excerpts(recording, consistent_model(), watch), Cancelled);
  CHECK(asked == 4);
}

TEST_CASE("Where a play takes place changes no score, nor which way it faces while the string is held") {
  const Recording tips = test::with_tips(300, test::beating_tips(11, 0.5));
  const Recording recording =
      test::played_by(consistent_model(), tips, test::hanging(tips, tips.string_length));
  for (Model model : {published_model(), paper_model(), consistent_model()}) {
    model.parameters.gravity = 9.7;  // so that no model is right
    const ExcerptScore here = score_excerpt(recording, model);
    const ExcerptScore there = score_excerpt(test::moved(recording, 0.0, {4.0, -2.0, 0.5}), model);
    REQUIRE((here.error && there.error));
    CHECK(*here.error > 1e-4);
    CHECK(*there.error == Approx(*here.error).epsilon(1e-6));
    CHECK(there.baseline_error == Approx(here.baseline_error).epsilon(1e-9));
    if (model.parameters.string_law != StringLaw::kInextensible) continue;  // world x is in their rules
    const ExcerptScore turned = score_excerpt(test::moved(recording, 0.6, {0.0, 0.0, 0.0}), model);
    REQUIRE(turned.error);
    CHECK(*turned.error == Approx(*here.error).epsilon(1e-6));
    CHECK(turned.baseline_error == Approx(here.baseline_error).epsilon(1e-9));
  }
}

TEST_CASE("Rows whose diabolo or predecessor is missing are not compared, and a start waits for its frames") {
  const Recording tips = test::with_tips(100, test::beating_tips(12, 0.2));
  Recording recording = test::played_by(consistent_model(), tips, test::hanging(tips, tips.string_length));
  for (const Eigen::Index row : {0, 40, 41}) {
    recording.diabolo.valid[row] = false;
    recording.diabolo.position.col(row).setConstant(kNaN);
  }
  const ExcerptScore score = score_excerpt(recording, consistent_model());
  CHECK(score.start_row == 1);
  CHECK(score.skipped == 3);
  CHECK(score.scored == 100 - 2 - 1 - 3);
  REQUIRE(score.error);
  CHECK(*score.error < 1e-6);  // it begins at rest
}

TEST_CASE("What follows an excerpt does not change its score") {
  Recording recording = test::with_tips(400, test::beating_tips(13, 0.3));
  recording =
      test::played_by(consistent_model(), recording, test::hanging(recording, recording.string_length));
  recording.name = "z_hop_1";
  for (const Model& model : {published_model(), paper_model(), consistent_model()}) {
    const std::vector<ExcerptScore> scores = score_excerpts(recording, model);
    REQUIRE(scores.size() == 2);
    const ExcerptScore alone = score_excerpt(cut(recording, 0, 180), model);
    CHECK(scores[0].motion == "hop");
    CHECK(scores[0].rows == 181);
    CHECK(scores[0].error == alone.error);
    CHECK(scores[0].paper_error == 0.07);
    CHECK(scores[1].motion.empty());
    CHECK(scores[1].rows == 400);
    CHECK(!scores[1].paper_error);
  }
}

TEST_CASE("A prediction that leaves the world is reported, not averaged") {
  Recording recording = test::with_tips(400, test::beating_tips(14, 10.0));
  recording.diabolo.valid.setConstant(true);  // it hovers above the tips
  recording.diabolo.position.colwise() = Eigen::Vector3d(0.2, 0.0, 1.3);
  Model model = published_model();
  model.parameters.gravity = 100.0;
  const ExcerptScore score = score_excerpt(recording, model);
  CHECK(!score.error);
  REQUIRE(score.diverged);
  CHECK(*score.diverged == Approx(std::sqrt(2.0 * 101.3 / 100.0)).epsilon(0.01));
  CHECK(std::isfinite(score.baseline_error));
}

TEST_CASE("A recording without a start or without a row to compare is refused") {
  Recording recording = test::with_tips(5, test::beating_tips(15, 1.0));
  CHECK(complaint([&] { score_excerpt(recording, consistent_model()); }) ==
        "recording \"played\": no two successive rows with the diabolo, and both tips, to start from");
  recording = test::played_by(consistent_model(), recording, test::hanging(recording, 1.46));
  CHECK(complaint([&] { score_excerpt(cut(recording, 0, 1), consistent_model()); }) ==
        "recording \"played\": no row to compare");
}

TEST_CASE("The published rules repeat the authors' program on the paper's five excerpts") {
  const auto folder = test::recordings_folder("the paper's table of position errors");
  if (!folder) return;
  for (const PaperExcerpt& excerpt : kPaperTable) {
    const bool circular = excerpt.motion == "circular acceleration";
    const std::filesystem::path take =
        *folder / (circular ? "2020-09-14_motion_extraction" : "2020-07-11_basic_physics") /
        (std::string(excerpt.recording) + ".csv");
    const ExcerptScore score = score_excerpts(load_recording(take), published_model()).front();
    CAPTURE(take, score.baseline_error);
    REQUIRE(score.error);
    CHECK(score.motion == excerpt.motion);
    CHECK(*score.error == Approx(excerpt.program_error).epsilon(0.02));
    CHECK(*score.error == Approx(excerpt.paper_error).margin(0.015));  // it prints two digits
  }
}

TEST_CASE("The baseline of the paper's excerpts is as published") {
  const auto folder = test::recordings_folder("the lowest-point baseline of the paper's excerpts");
  if (!folder) return;
  const auto baseline = [&](const char* take) {
    return score_excerpts(load_recording(*folder / take), consistent_model()).front().baseline_error;
  };
  CHECK(baseline("2020-07-11_basic_physics/throw_1.csv") == Approx(0.198).epsilon(0.02));
  CHECK(baseline("2020-07-11_basic_physics/y_swing_2.csv") == Approx(0.396).epsilon(0.02));
  CHECK(baseline("2020-07-11_basic_physics/z_hop_1.csv") == Approx(0.053).epsilon(0.02));
  CHECK(baseline("2020-07-11_basic_physics/acceleration_1.csv") == Approx(0.035).epsilon(0.02));
  CHECK(baseline("2020-09-14_motion_extraction/circular_accel_stick_motion.csv") ==
        Approx(0.296).epsilon(0.02));
}
