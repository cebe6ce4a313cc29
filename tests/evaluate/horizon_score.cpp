// SPDX-License-Identifier: MIT
#include "diabolo/evaluate/horizon_score.hpp"

#include "catch.hpp"
#include "diabolo/json/recording_file.hpp"
#include "recording/played.hpp"
#include "recording/support.hpp"

using namespace diabolo;

namespace {

Recording beaten(std::uint64_t seed, Eigen::Index rows = 800) {
  const Recording tips = test::with_tips(rows, test::beating_tips(seed, 0.2));
  Recording recording = test::played_by(consistent_model(), tips, test::hanging(tips, tips.string_length));
  Random random(seed);  // a millimetre of noise, so that no prediction is perfect
  for (Eigen::Index i = 0; i < rows; ++i) recording.diabolo.position.col(i) += random.vector(1e-3);
  return recording;
}

bool same(const std::optional<ErrorSummary>& a, const std::optional<ErrorSummary>& b) {
  if (!a || !b) return !a && !b;
  const bool same_interval = a->mean_ci95 ? b->mean_ci95 && a->mean_ci95->low == b->mean_ci95->low &&
                                                a->mean_ci95->high == b->mean_ci95->high
                                          : !b->mean_ci95;
  return a->windows == b->windows && a->mean == b->mean && a->median == b->median &&
         a->percentile_90 == b->percentile_90 && same_interval;
}

std::string refusal(const HorizonOptions& options) {
  try {
    score_horizons(beaten(1, 30), consistent_model(), options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "(no complaint)";
}

}  // namespace

TEST_CASE("A perfect model makes no error from fair starts in flight, up to and after the catch") {
  const Recording recording = test::thrown();
  const std::vector<HorizonScore> fair =
      score_horizons(recording, consistent_model(), {.starts_every = 0.05, .horizons = {0.2, 0.6}});
  const std::vector<HorizonScore> published =
      score_horizons(recording, consistent_model(),
                     {.starts_every = 0.05, .horizons = {0.2, 0.6}, .start = Start::kPublished});
  REQUIRE(fair[1].model);
  CHECK(fair[1].windows == 8);  // rows 18 to 62, every sixth or so
  CHECK(fair[1].model->percentile_90 < 1e-8);
  CHECK(published[1].windows == fair[1].windows);
  CHECK(published[1].model->median > 1e-3);  // half a frame of gravity in the velocity
}

TEST_CASE("The number of threads changes nothing, and the seed only the intervals") {
  const Recording recording = beaten(2);
  const std::vector<HorizonScore> one = score_horizons(recording, published_model(), {.threads = 1});
  const std::vector<HorizonScore> many = score_horizons(recording, published_model(), {.threads = 5});
  const std::vector<HorizonScore> seeded = score_horizons(recording, published_model(), {.seed = 77});
  REQUIRE(one.size() == 5);
  for (std::size_t h = 0; h < one.size(); ++h) {
    CHECK(same(one[h].model, many[h].model));
    CHECK(same(one[h].baseline, many[h].baseline));
    CHECK(one[h].advantage == many[h].advantage);
    CHECK(one[h].model->mean == seeded[h].model->mean);
    CHECK(one[h].model->windows + one[h].failed == one[h].windows);
    CHECK(*one[h].advantage == Approx(one[h].baseline->mean - one[h].model->mean));
  }
  CHECK(!same(one[0].model, seeded[0].model));
}

TEST_CASE("All models and starts are compared in the same windows, and recordings add up") {
  const Recording first = beaten(3, 400), second = beaten(4, 500);
  const auto windows = [](const std::vector<HorizonScore>& scores) {
    std::vector<std::size_t> counts;
    for (const HorizonScore& score : scores) counts.push_back(score.windows);
    return counts;
  };
  const std::vector<std::size_t> expected = windows(score_horizons(first, consistent_model()));
  CHECK(windows(score_horizons(first, published_model())) == expected);
  CHECK(windows(score_horizons(first, paper_model(), {.start = Start::kPublished})) == expected);
  const std::vector<HorizonScore> both = score_horizons({&first, &second}, consistent_model());
  const std::vector<HorizonScore> a = score_horizons(first, consistent_model());
  const std::vector<HorizonScore> b = score_horizons(second, consistent_model());
  for (std::size_t h = 0; h < both.size(); ++h) {
    REQUIRE(both[h].windows == a[h].windows + b[h].windows);
    const double na = static_cast<double>(a[h].windows), nb = static_cast<double>(b[h].windows);
    CHECK(both[h].model->mean == Approx((a[h].model->mean * na + b[h].model->mean * nb) / (na + nb)));
  }
}

TEST_CASE("A prediction is the same in a recording that was cut before its start") {
  const Recording whole = beaten(5, 600);
  const HorizonOptions options{.starts_every = 0.08, .horizons = {0.5}};  // ten rows
  for (Model model : {published_model(), consistent_model()}) {
    model.parameters.gravity = 9.5;
    const HorizonTask all(whole, model, options), late(cut(whole, 200, 599), model, options);
    const double tolerance = model.interpolation == Interpolation::kHeld ? 1e-9 : 1e-6;
    REQUIRE(late.size() > 20);
    for (std::size_t i = 0; i < late.size(); ++i) {
      const std::size_t same_start = all.size() - late.size() + i;
      REQUIRE(late.errors(i)[0].comparable);
      REQUIRE(late.errors(i)[0].model == Approx(all.errors(same_start)[0].model).margin(tolerance));
    }
  }
}

TEST_CASE("Moving a play, and turning it while the string is held, changes no score") {
  const Recording here = beaten(6);
  const Recording there = test::moved(here, 0.0, {2.0, -1.0, 0.5}),
                  turned = test::moved(here, 0.5, {0, 0, 0});
  for (const Model& model : {published_model(), paper_model(), consistent_model()}) {
    const std::vector<HorizonScore> a = score_horizons(here, model), b = score_horizons(there, model);
    for (std::size_t h = 0; h < a.size(); ++h) {
      CHECK(b[h].model->mean == Approx(a[h].model->mean).epsilon(1e-5));
      CHECK(b[h].baseline->mean == Approx(a[h].baseline->mean).epsilon(1e-9));
    }
  }
  const std::vector<HorizonScore> a = score_horizons(here, consistent_model());
  const std::vector<HorizonScore> b = score_horizons(turned, consistent_model());
  for (std::size_t h = 0; h < a.size(); ++h)
    CHECK(b[h].model->mean == Approx(a[h].model->mean).epsilon(1e-5));
}

TEST_CASE("Predictions that leave the world are counted and left out") {
  Recording recording = test::with_tips(600, test::beating_tips(7, 10.0));
  recording.diabolo.valid.setConstant(true);  // it hovers above the tips
  recording.diabolo.position.colwise() = Eigen::Vector3d(0.2, 0.0, 1.3);
  Model model = published_model();
  model.parameters.gravity = 100.0;
  const std::vector<HorizonScore> scores = score_horizons(recording, model, {.horizons = {0.48, 1.6}});
  CHECK(scores[0].failed == 0);
  CHECK(scores[0].model->mean == Approx(0.5 * 100.0 * 0.48 * 0.48));
  CHECK(scores[0].missed_catches == scores[0].windows);
  CHECK(scores[1].windows > 0);
  CHECK(scores[1].failed == scores[1].windows);
  CHECK(!scores[1].model);
  CHECK(!scores[1].advantage);
  CHECK(scores[1].baseline->windows == scores[1].windows);
}

TEST_CASE("A recording too short for a horizon gives no figure for it") {
  const std::vector<HorizonScore> scores = score_horizons(beaten(8, 40), consistent_model());
  CHECK(scores[0].windows == 1);
  CHECK(scores[0].model);
  CHECK(!scores[0].model->mean_ci95);
  CHECK(scores[4].windows == 0);
  CHECK(!scores[4].model);
  CHECK(!scores[4].baseline);
}

TEST_CASE("Options out of range are refused") {
  CHECK(refusal({.starts_every = 0.0}) == "starts_every: 0 s; must be at least 0.001 s and finite");
  CHECK(refusal({.starts_every = kNaN}) == "starts_every: nan s; must be at least 0.001 s and finite");
  CHECK(refusal({.horizons = {}}) == "horizons: none; at least one expected");
  CHECK(refusal({.horizons = {0.1, -1.0}}) == "horizon: -1 s; must be > 0 and at most 60 s");
  CHECK(refusal({.threads = -1}) == "threads: -1; must be 0 (one for every processor) or more");
}

TEST_CASE("On the real takes the fair start predicts better than the published one") {
  const auto folder = test::recordings_folder("fair starts on the real takes");
  if (!folder) return;
  std::vector<Recording> takes;
  for (const char* take :
       {"acceleration_1", "right_hand_extend_1", "throw_1", "y_swing_2", "z_hop_1", "z_hop_2"})
    takes.push_back(load_recording(*folder / "2020-07-11_basic_physics" / (std::string(take) + ".csv")));
  std::vector<const Recording*> recordings;
  for (const Recording& take : takes) recordings.push_back(&take);
  for (const Model& model : {published_model(), paper_model(), consistent_model()}) {
    const HorizonOptions fair{.horizons = {0.1, 0.25}},
        published{.horizons = {0.1, 0.25}, .start = Start::kPublished};
    const std::vector<HorizonScore> a = score_horizons(recordings, model, fair);
    const std::vector<HorizonScore> b = score_horizons(recordings, model, published);
    for (std::size_t h = 0; h < 2; ++h) {
      CAPTURE(model.name, h, a[h].windows);
      CHECK(a[h].failed == 0);
      CHECK(a[h].model->mean < b[h].model->mean);
      CHECK(a[h].advantage_ci95->low > 0.0);
    }
  }
}

TEST_CASE("A law in time is predicted in a part as in the whole") {
  Model model = consistent_model();
  const Law gust("gust", "a gust", Acts::kLeft, "size * sin(2 * pi * 0.7 * t)",
                 {{"size", "m/s^2", 1.0, 0.0, -9.0, 9.0}});
  model.effects.get<FormulaLaws>() = FormulaLaws<double>({gust});
  model.effects.get<FormulaLaws>().numbers[0] = 2.0;
  const Recording whole = beaten(5);
  const Eigen::Index first = 240;
  HorizonOptions options;
  options.starts_every = 240.0 / whole.rate;
  options.horizons = {0.5};
  const HorizonTask in_whole(whole, model, options),
      in_part(cut(whole, first, whole.size() - 1), model, options);
  const double of_whole = in_whole.errors(1).front().model, of_part = in_part.errors(0).front().model;
  CAPTURE(of_whole, of_part);
  CHECK(of_part == Approx(of_whole).epsilon(0.02));
  Recording forgetful = cut(whole, first, whole.size() - 1);
  forgetful.clock = 0.0;
  CHECK(std::abs(HorizonTask(forgetful, model, options).errors(0).front().model - of_whole) > 0.1 * of_whole);
}
