// SPDX-License-Identifier: MIT
#include "diabolo/evaluate/windows.hpp"

#include "catch.hpp"
#include "recording/played.hpp"
#include "recording/support.hpp"

using namespace diabolo;

namespace {

/// Whether the tip is seen at or before the first row, and again and again up to the last, never more than
/// kLongestTipGap apart.
bool followed(const Track& tip, const Eigen::VectorXd& times, Eigen::Index first, Eigen::Index last) {
  Eigen::Index seen = first;
  while (seen >= 0 && !tip.valid[seen]) --seen;
  if (seen < 0) return false;
  for (Eigen::Index i = seen + 1; i < times.size(); ++i) {
    if (!tip.valid[i]) continue;
    if (times[i] - times[seen] > kLongestTipGap + 1e-5) return false;
    if (i >= last) return true;
    seen = i;
  }
  return false;
}

}  // namespace

TEST_CASE("Windows are those that the rules allow, one by one") {
  const std::uint32_t seed = test::fresh_seed();
  INFO("seed " << seed);
  Random random(seed);
  const std::vector<double> horizons{0.104, 0.256, 0.512};
  int windows_seen = 0, refused = 0;
  for (int k = 0; k < 30; ++k) {
    const Recording tips =
        test::with_tips(400, test::beating_tips(seed + static_cast<std::uint32_t>(k), 0.1));
    Recording recording = test::played_by(consistent_model(), tips, test::hanging(tips, tips.string_length));
    for (Track* track : {&recording.left, &recording.right, &recording.diabolo})
      for (int gap = random.index(4); gap > 0; --gap) {
        const Eigen::Index first = random.index(380), length = 1 + random.index(20);
        track->valid.segment(first, length).setConstant(false);
        track->position.middleCols(first, length).setConstant(kNaN);
      }
    const StartStates starts(recording, true);
    const Eigen::VectorXd times = row_times(recording);
    const std::vector<PredictionWindow> windows =
        prediction_windows(recording, starts, times, 0.08, horizons);
    auto window = windows.begin();
    for (Eigen::Index start = 0; start < 400; start += 10) {
      std::vector<std::optional<Eigen::Index>> expected(horizons.size());
      const bool known = starts.known(Start::kFair, start) && starts.known(Start::kPublished, start);
      for (std::size_t h = 0; h < horizons.size() && known; ++h) {
        const Eigen::Index row = start + std::lround(horizons[h] * recording.rate);
        if (row < 400 && recording.diabolo.valid[row] && followed(recording.left, times, start, row) &&
            followed(recording.right, times, start, row))
          expected[h] = row;
      }
      if (std::ranges::none_of(expected, [](const auto& row) { return row.has_value(); })) {
        ++refused;
        continue;
      }
      REQUIRE(window != windows.end());
      REQUIRE(window->start == start);
      REQUIRE(window->rows == expected);
      ++window;
      ++windows_seen;
    }
    REQUIRE(window == windows.end());
  }
  CHECK(windows_seen > 100);
  CHECK(refused > 100);
}

TEST_CASE("A gap of a tip counts from its last sample to its next") {
  const Recording recording = test::with_tips(60, test::beating_tips(1, 0.0), 100.0);
  for (const auto& [length, is_long] : {std::pair<Eigen::Index, bool>{9, false}, {10, true}}) {
    Track tip = recording.left;
    tip.valid.segment(20, length).setConstant(false);
    const std::vector<bool> marks = in_long_gap(tip, row_times(recording));
    CHECK(!marks[18]);
    CHECK(marks[19] == is_long);
    CHECK(marks[static_cast<std::size_t>(19 + length)] == is_long);
    CHECK(!marks[static_cast<std::size_t>(20 + length)]);
    CHECK(marks[59]);  // nothing comes after it
  }
}

TEST_CASE("A horizon between two rows is compared at the earlier one, from every start") {
  const Recording tips = test::with_tips(200, test::beating_tips(2, 0.0));
  const Recording recording =
      test::played_by(consistent_model(), tips, test::hanging(tips, tips.string_length));
  const StartStates starts(recording, true);
  const std::vector<PredictionWindow> windows =
      prediction_windows(recording, starts, row_times(recording), 0.008, {12.5 / 125.0});
  REQUIRE(windows.size() >= 200 - 13 - 12 - 1);
  for (const PredictionWindow& window : windows) {
    REQUIRE(window.rows[0]);
    CHECK(*window.rows[0] == window.start + 12);
  }
}

TEST_CASE("Starts that fall on one row count once, and an empty recording has none") {
  const Recording tips = test::with_tips(60, test::beating_tips(1, 0.0));
  const Recording recording =
      test::played_by(consistent_model(), tips, test::hanging(tips, tips.string_length));
  const StartStates starts(recording, true);
  const std::vector<PredictionWindow> windows =
      prediction_windows(recording, starts, row_times(recording), 0.001, {0.104});
  for (std::size_t i = 1; i < windows.size(); ++i) CHECK(windows[i].start == windows[i - 1].start + 1);
  CHECK(windows.size() == 60 - 13 - 13);
}
